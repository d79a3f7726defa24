//! Casts that hunts found, each by its numbers.

use crate::bodies::{self, Body};
use crate::oracle::Oracle;
use feeler::narrow_phase::exact::flat_crossing;
use glam::{DQuat, DVec3};

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// Two casts that found the search's rounding, at any size.
#[test]
fn a_box_that_glides_along_its_own_edge_past_a_vertex() {
    // The edge passes the vertex at 3e-15 m, 5e-10 off the motion: from points that lie 1e-4 m
    // along the ray, what is across it was lost in rounding, and another face was taken.
    let a = bodies::cuboid(DVec3::splat(5.772862902566831e-5));
    let b = bodies::polytope(&[
        v(
            -0.0006972024459588127,
            -0.00033076452250790456,
            -0.0011100435274490185,
        ),
        v(
            -0.0006582025427716234,
            -0.0008300050655289709,
            -0.0008399726523628681,
        ),
        v(
            6.282977343951387e-5,
            0.0009654291708620882,
            -0.0009442944394892801,
        ),
        v(
            0.0007685946720866205,
            -0.000329905188414448,
            0.001062128923214871,
        ),
        v(
            0.00030749224332483617,
            0.0012440792112773855,
            0.00043059086055650513,
        ),
        v(
            -0.00020207736951498135,
            0.0006477456829851521,
            -0.0011693089068917153,
        ),
    ]);
    let turns = [
        DQuat::from_xyzw(
            1.852496511527457e-10,
            2.516143094883625e-10,
            1.1623152345461182e-10,
            1.0,
        ),
        DQuat::from_xyzw(
            0.4863644784729642,
            -0.2704753198204577,
            -0.4752694257774545,
            0.6814775626305765,
        ),
    ];
    let between = v(
        -0.000642840146363889,
        -0.0012136139524459954,
        -0.0014505362295302534,
    );
    turned(&a, &b, turns, between, v(0.0, 0.0, 0.007866895029216447));
}

#[test]
fn a_slab_that_leaves_a_needle_by_its_rim() {
    // The rim is 1e-9 off the motion: of the areas by which the place on it was found, seen
    // along the motion, one part in 1e4 was rounding.
    let a = bodies::cuboid(v(6.883056702496231, 4.339513161661147, 0.0688305670249623));
    let b = bodies::polytope(&[
        v(45.234794886617955, -0.3981005134984768, 0.07365686329464365),
        v(-3.2464255136869666, 0.17243915752495026, -0.520938394523707),
        v(
            -7.187369213040211,
            0.7616956279526153,
            -0.023243634304010285,
        ),
        v(48.40818278872898, -0.3154176107635005, -0.06554292704337002),
        v(28.269726845576386, 0.43994963832917433, -0.3363508032383828),
        v(8.586940431149552, -0.7589528613216974, 0.018802724234675317),
        v(-33.75923809217297, -0.5888689943376496, 0.06957571054787202),
    ]);
    let turns = [
        DQuat::from_xyzw(
            -7.210274530307574e-10,
            4.7630357038846955e-11,
            1.4571233452242724e-10,
            1.0,
        ),
        DQuat::from_xyzw(
            0.429005036533066,
            -0.3902876974375759,
            0.803942600050183,
            0.13155412453697213,
        ),
    ];
    let between = v(-4.564272489205385, -6.824811994082326, -153.58371562675242);
    turned(&a, &b, turns, between, v(0.0, 0.0, 26.044153334792558));
}

/// Casts turned bodies both ways.
fn turned(a: &Body, b: &Body, [turn_a, turn_b]: [DQuat; 2], between: DVec3, motion: DVec3) {
    for motion in [motion, -motion] {
        let found = flat_crossing(&a.shape, turn_a, &b.shape, turn_b, between, motion);
        assert!(found.is_some(), "they meet");
        let oracle = Oracle::new((&a.hull, turn_a), (&b.hull, turn_b), between, motion);
        assert_eq!(oracle.complaint(found.as_ref()), None, "{motion} {found:?}");
    }
}

/// Along an edge of one, in the plane of a face of their difference: all that was left of the
/// place on that face was rounding, and the exit came 0.1 motions late.
#[test]
fn a_slab_that_glides_off_a_box_along_its_own_edge() {
    let half_a = v(
        0.014858768035123236,
        0.00686223074150386,
        0.00014858768035123232,
    );
    let half_b = v(
        0.007291690922343988,
        0.003134263525194147,
        0.0029940241677749316,
    );
    let turns = [
        DQuat::from_xyzw(
            0.27788558539142083,
            -0.26554932405282905,
            -0.9094752914568881,
            0.15848612606837637,
        ),
        DQuat::from_xyzw(
            -0.5030142373059566,
            0.04277837047402653,
            -0.2985143039259866,
            0.8099604301684604,
        ),
    ];
    let between = v(
        0.06421798723958409,
        0.04348651547903946,
        0.027008801415161657,
    );
    let motion = v(
        -0.004699649038345776,
        -0.0025755602042307523,
        -0.0024894367318880374,
    );
    let [a, b] = [half_a, half_b].map(bodies::cuboid);
    turned(&a, &b, turns, between, motion);
    let [a, b] = [a, b].map(|body| bodies::polytope(&body.hull.points));
    turned(&a, &b, turns, between, motion);
}

/// Rounding told which of their edges met, and the point lay 1e-5 of the size outside of one.
#[test]
fn boxes_whose_faces_are_parallel_but_for_a_hair_share_the_point() {
    let a = bodies::cuboid(DVec3::splat(5.766002770787062));
    let turns = [
        DQuat::IDENTITY,
        DQuat::from_xyzw(
            9.998574044504985e-14,
            -1.0106499535758387e-12,
            -8.289032755412742e-13,
            1.0,
        ),
    ];
    let between = v(13.499849636777608, 1.8580272257644994, -56.73657235090751);
    turned(
        &a,
        &a,
        turns,
        between,
        v(-1.304675752678388, -1.7412995551396069, 37.61634211306881),
    );
}

/// The crossing of two edges that lie in faces tilted by 4e-11 against each other came out 6e-7 of the
/// size beyond one's end.
#[test]
fn cubes_whose_faces_are_tilted_by_a_hair_share_the_point() {
    let cube = bodies::cuboid(DVec3::splat(0.5203184869751887));
    let turns = [
        DQuat::from_xyzw(
            -2.2112182104970397e-11,
            1.0549212548385123e-11,
            -1.7272500676280517e-11,
            1.0,
        ),
        DQuat::IDENTITY,
    ];
    let between = v(3.970822294476856, -1.7963551789502843, -2.7322294002083236);
    turned(
        &cube,
        &cube,
        turns,
        between,
        v(-0.5007582714667631, 0.22653735625131088, 0.2133257794583872),
    );
}

/// The same, of a large and a small one tilted by 4e-10: 1e-7 of the size.
#[test]
fn cubes_of_two_sizes_tilted_by_a_hair_share_the_point() {
    let large = bodies::cuboid(DVec3::splat(0.0001115963443814841));
    let small = bodies::cuboid(DVec3::splat(2.9512827017320293e-5));
    let turns = [
        DQuat::from_xyzw(
            -1.872820711073029e-10,
            3.600561706012553e-11,
            -2.1268009039954576e-10,
            1.0,
        ),
        DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2),
    ];
    let between = v(
        0.00017119727242478295,
        6.7525383414278925e-6,
        0.0001610205410208362,
    );
    let motion = v(
        -7.193608873478861e-5,
        0.00018010502336307537,
        -0.0001887264639814356,
    );
    turned(&large, &small, turns, between, motion);
}

/// In its own plane: what is left of the difference's thickness is rounding.
#[test]
fn a_triangle_that_slides_onto_itself_in_its_plane() {
    let triangle = bodies::triangle([
        v(
            0.0015274966605156259,
            -0.0112321913902947,
            0.007810196893016277,
        ),
        v(
            -0.008333224239120975,
            -0.004513056782811052,
            0.00998419937899017,
        ),
        v(
            -0.003346212132063177,
            -0.008200119354663728,
            -0.010538285055941524,
        ),
    ]);
    let turn = DQuat::from_xyzw(
        0.11698414302950545,
        0.2582894746892765,
        -0.009887281714531895,
        0.9589074508025721,
    );
    let between = v(
        -0.05024912080617401,
        0.027180009515802274,
        -0.044792721284585856,
    );
    let motion = v(
        0.0752130857412532,
        -0.04016128185378188,
        0.07105417625724168,
    );
    turned(&triangle, &triangle, [turn, turn], between, motion);
}

/// The needle's end is so small that the tilt of the triangle does not show on it.
#[test]
fn a_needle_s_end_on_a_triangle_that_is_tilted_by_a_hair() {
    let needle = bodies::cuboid(v(
        0.0003712855841075976,
        0.0003712855841075976,
        0.03712855841075976,
    ));
    let triangle = bodies::triangle([
        DVec3::ZERO,
        v(0.02049276609138346, 0.0, 0.0),
        v(-0.005131015706528049, 0.02049276609138346, 0.0),
    ]);
    let turns = [
        DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2),
        DQuat::from_xyzw(
            1.941957201702514e-12,
            -3.3117911789601198e-12,
            -4.879920410718424e-12,
            1.0,
        ),
    ];
    let between = v(
        -0.09331837130307974,
        -0.026077296672636897,
        0.15201292214099135,
    );
    let motion = v(
        0.03767302091616709,
        0.019871769804766334,
        -0.04928529638282231,
    );
    turned(&needle, &triangle, turns, between, motion);
}
