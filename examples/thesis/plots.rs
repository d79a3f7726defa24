//! Plots as SVG files.

use plotters::chart::MeshStyle;
use plotters::coord::Shift;
use plotters::coord::ranged1d::ValueFormatter;
use plotters::prelude::*;
use std::error::Error;
use std::path::Path;

/// Colours that are told apart by everyone (Okabe and Ito, 2008).
pub(crate) const ORANGE: RGBColor = RGBColor(213, 94, 0);
pub(crate) const BLUE: RGBColor = RGBColor(0, 114, 178);
pub(crate) const GREEN: RGBColor = RGBColor(0, 158, 115);
pub(crate) const PURPLE: RGBColor = RGBColor(150, 80, 140);

pub(crate) const INK: RGBColor = RGBColor(60, 60, 60);
const SIZE: (u32, u32) = (960, 600);

/// A line through points, and its name.
pub(crate) struct Series {
    pub name: String,
    pub colour: RGBColor,
    /// Measured elsewhere: hollow points, a thin line.
    pub foreign: bool,
    pub points: Vec<(f64, f64)>,
}

/// A plot over the number of rays, which runs logarithmically.
pub(crate) struct Plot<'a> {
    pub title: &'a str,
    pub unit: &'a str,
    /// Whether the vertical axis runs logarithmically too.
    pub logarithmic: bool,
    pub series: Vec<Series>,
}

impl Plot<'_> {
    pub(crate) fn draw(&self, path: &Path) -> Result<(), Box<dyn Error>> {
        let root = SVGBackend::new(path, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let (head, body) = root.split_vertically(96);
        self.draw_head(&head)?;
        let points = || self.series.iter().flat_map(|series| &series.points);
        let ends = |values: &mut dyn Iterator<Item = f64>| {
            values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| {
                (low.min(value), high.max(value))
            })
        };
        let (left, right) = ends(&mut points().map(|point| point.0));
        let (low, high) = ends(&mut points().map(|point| point.1));
        let across = (left * 0.85..right * 1.18).log_scale();
        let mut builder = ChartBuilder::on(&body);
        builder
            .margin(12)
            .margin_right(28)
            .x_label_area_size(52)
            .y_label_area_size(76);
        if self.logarithmic {
            let up =
                (10_f64.powf(low.log10().floor())..10_f64.powf(high.log10().ceil())).log_scale();
            let mut chart = builder.build_cartesian_2d(across, up)?;
            let mut mesh = chart.configure_mesh();
            self.style(&mut mesh)?;
            for series in &self.series {
                chart.draw_series(series.line())?;
                chart.draw_series(series.marks())?;
            }
        } else {
            let bottom = ((low - 1.0) / 10.0).floor().max(0.0) * 10.0;
            let mut chart = builder.build_cartesian_2d(across, bottom..101.0)?;
            let mut mesh = chart.configure_mesh();
            self.style(&mut mesh)?;
            for series in &self.series {
                chart.draw_series(series.line())?;
                chart.draw_series(series.marks())?;
            }
        }
        root.present()?;
        Ok(())
    }

    /// Title and legend: above the plot, where they hide no data.
    fn draw_head<B: DrawingBackend>(
        &self,
        head: &DrawingArea<B, Shift>,
    ) -> Result<(), Box<dyn Error>>
    where
        B::ErrorType: 'static,
    {
        let text = |size: i32| ("sans-serif", size).into_font().color(&INK);
        head.draw(&Text::new(self.title, (20, 18), text(24)))?;
        // Two rows if there are more than three, one below the other what belongs together.
        let columns = match self.series.len() {
            few @ ..=3 => few.max(1),
            many => many.div_ceil(2),
        };
        for (index, series) in self.series.iter().enumerate() {
            let x = 22 + (index % columns) as i32 * (900 / columns as i32);
            let y = 58 + (index / columns) as i32 * 22;
            head.draw(&PathElement::new(
                vec![(x, y), (x + 34, y)],
                series.stroke(),
            ))?;
            head.draw(&Circle::new((x + 17, y), 4, WHITE.filled()))?;
            head.draw(&Circle::new((x + 17, y), 4, series.mark()))?;
            head.draw(&Text::new(series.name.as_str(), (x + 44, y - 8), text(16)))?;
        }
        Ok(())
    }
}

impl Plot<'_> {
    /// Axes and grid, whatever the vertical axis.
    fn style<X, Y, B>(&self, mesh: &mut MeshStyle<'_, '_, X, Y, B>) -> Result<(), Box<dyn Error>>
    where
        X: Ranged<ValueType = f64> + ValueFormatter<f64>,
        Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
        B: DrawingBackend,
        B::ErrorType: 'static,
    {
        let text = |size: i32| ("sans-serif", size).into_font().color(&INK);
        mesh.axis_style(INK)
            .bold_line_style(RGBColor(222, 222, 222))
            .light_line_style(RGBColor(243, 243, 243))
            .label_style(text(16))
            .axis_desc_style(text(17))
            .x_desc("rays")
            .y_desc(self.unit)
            .x_label_formatter(&|x| format!("{x}"))
            .y_label_formatter(&|y| {
                // Powers of ten are not met to the last digit.
                if *y > 0.0 && *y < 9e-4 {
                    format!("{y:.0e}")
                } else {
                    format!("{}", (y * 1e4).round() / 1e4)
                }
            })
            .draw()?;
        Ok(())
    }
}

impl Series {
    fn stroke(&self) -> ShapeStyle {
        self.colour.stroke_width(if self.foreign { 2 } else { 3 })
    }

    fn mark(&self) -> ShapeStyle {
        if self.foreign {
            self.colour.stroke_width(2)
        } else {
            self.colour.filled()
        }
    }

    fn line<B: DrawingBackend>(&self) -> LineSeries<B, (f64, f64)> {
        LineSeries::new(self.points.iter().copied(), self.stroke())
    }

    fn marks(&self) -> impl Iterator<Item = Circle<(f64, f64), i32>> + '_ {
        (self.points.iter()).map(|&point| Circle::new(point, 4, self.mark()))
    }
}
