//! The thesis's table of arc lengths.

use feeler::{ArcLengthRow, ArcLengthTable, Spline};

/// Table 2.1 of the thesis.
const LENGTHS: [f64; 22] = [
    0.098821, 0.205607, 0.335634, 0.502465, 0.717651, 0.991541, 1.333926, 1.754365, 2.262342,
    2.867329, 3.283585, 3.575692, 3.760232, 3.927716, 4.204640, 4.640662, 5.256506, 6.066346,
    7.082381, 8.316070, 9.376211, 10.183034,
];

#[test]
fn the_tables_worked_example_comes_out_as_in_the_thesis() {
    let rows = LENGTHS
        .iter()
        .enumerate()
        .map(|(index, length)| ArcLengthRow {
            piece: index / 10,
            u: (index % 10 + 1) as f64 / 10.0,
            length: *length,
        });
    let table = ArcLengthTable::from_rows(rows).unwrap();
    let (piece, u) = table.locate(0.61);
    assert_eq!(piece, 0);
    assert!((u - 0.449_973_1).abs() < 1e-7, "{u}");
    assert!(((u - 0.4) / 0.1 - 0.499_730_5).abs() < 1e-6);
    // Between rows 10 and 11 u runs from 0 on the next piece.
    let (piece, u) = table.locate(0.5 * (2.867329 + 3.283585));
    assert_eq!(piece, 1);
    assert!((u - 0.05).abs() < 1e-12, "{u}");
    assert_eq!(table.locate(0.5 * 0.098821), (0, 0.05));
    assert_eq!(table.locate(-1.0), (0, 0.0));
    assert_eq!(table.locate(f64::NAN), (0, 0.0));
    assert_eq!(table.locate(99.0).0, 2);
    assert!((table.locate(99.0).1 - 0.2).abs() < 1e-15);
}

#[test]
fn the_table_errs_with_the_square_of_its_steps() {
    // Scene 7 of the thesis.
    let spline = Spline::with_tangents(
        [
            [-5.0, 5.0, 0.0],
            [0.0, 0.0, 0.0],
            [-5.0, -5.0, 0.0],
            [-10.0, 0.0, 0.0],
        ],
        [
            [1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
        ],
    )
    .unwrap();
    let worst = |steps: usize| {
        let table = ArcLengthTable::from_spline(&spline, steps).unwrap();
        assert_eq!(table.rows().len(), 3 * steps);
        let worst = (0..=1000).map(|i| {
            let distance = f64::from(i) / 1000.0 * table.length();
            let (piece, u) = table.locate(distance);
            (spline.distance_at(piece, u) - distance).abs()
        });
        worst.fold(0.0, f64::max)
    };
    let errors = [10, 20, 40, 80, 160].map(worst);
    assert!((1e-3..0.2).contains(&errors[0]), "{errors:?}");
    for pair in errors.windows(2) {
        assert!((2.5..5.5).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
}
