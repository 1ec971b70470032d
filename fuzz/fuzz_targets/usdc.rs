//! Any bytes as a crate: they are refused with a place or read, all of them and as a groom.
#![no_main]

use groom_formats::{Format, ReadOptions, read_from};
use libfuzzer_sys::fuzz_target;
use usd_layer::{Layer, Prim, Value};

fn read(layer: &Layer<&[u8]>, prim: &Prim) {
    for attribute in &prim.attributes {
        let samples = attribute.samples.iter().flat_map(|samples| &samples.values);
        for value in attribute.default.iter().chain(samples) {
            if let Value::Array(_) = value {
                let _ = (layer.texts(value), layer.numbers::<f64>(value), layer.values::<f32, 3>(value));
                let _ = (layer.numbers::<i32>(value), layer.values::<f32, 2>(value), layer.values::<f64, 16>(value));
            }
        }
    }
    prim.children.iter().for_each(|child| read(layer, child));
}

fuzz_target!(|bytes: &[u8]| {
    if let Ok(layer) = Layer::read(bytes) {
        layer.prims.iter().for_each(|prim| read(&layer, prim));
    }
    let _ = read_from(Format::Usdc, bytes, "fuzz", &ReadOptions::default());
});
