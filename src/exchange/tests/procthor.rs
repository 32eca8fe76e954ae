//! Houses of ProcTHOR.

use orthoframe_exchange::{Assets, read_procthor};
use orthoframe_units::Source;

#[test]
fn what_hangs_a_little_above_what_it_lies_on_has_fallen() {
    let boxed = |x: f64, y: f64| format!(r#"{{"x": {x}, "y": {y}, "z": {x}}}"#);
    let asset = |id: &str, size: String| {
        format!(r#""{id}": [{{"assetId": "{id}", "boundingBox": {size}}}]"#)
    };
    let assets = [asset("Desk", boxed(1.0, 0.8)), asset("Vase", boxed(0.2, 0.3))].join(",");
    let assets = Assets::read(&Source::new("assets", format!("{{{assets}}}"))).unwrap();
    // Feet 5.5 cm above the top, 9 cm above it, in a drawer, and 5 cm above what else lies there.
    for (middle, bottom) in [(1.005, 80.0), (1.04, 89.0), (0.45, 30.0), (0.50, 30.0)] {
        let at = |y: f64| format!(r#""position": {{"x": 2, "y": {y}, "z": 2}}"#);
        let vases =
            [middle, 0.45].map(|y| format!(r#"{{"id": "v", "assetId": "Vase", {}}}"#, at(y)));
        let vases = vases.join(",");
        let desk = at(0.4);
        let house = format!(
            r#"{{"rooms": [{{"id": "r", "floorPolygon":
                    [{{"x": 0, "y": 0, "z": 0}}, {{"x": 0, "y": 0, "z": 4}}, {{"x": 4, "y": 0, "z": 4}}]}}],
                   "objects": [{{"id": "d", "assetId": "Desk", {desk}, "children": [{vases}]}}]}}"#
        );
        let survey = read_procthor(&Source::new("house", house), &assets).unwrap();
        let things = &survey.levels[0].things;
        assert!((things[1].z.get() - bottom).abs() < 0.02, "{:?}", things[1]);
    }
}
