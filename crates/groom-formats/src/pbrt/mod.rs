//! Strands as pbrt's curves, `.pbrt`, written: a file to `Include` in a scene.
//!
//! ```text
//! AttributeBegin
//! Material "hair" "rgb sigma_a" [ ... ] "float beta_m" [ ... ] ...
//! Shape "curve" "string type" "cylinder" "string basis" "bezier" "point3 P" [ ... ] "float width0" [ ... ] "float width1" [ ... ]
//! ...
//! AttributeEnd
//! ```
//!
//! pbrt has only cubic curves. A strand becomes the Catmull-Rom curve through its points, written as Bezier
//! spans, with points beyond its ends that continue the first and the last segment (`2 a - b`): the curve
//! passes every point, and at the ends it points along the segments there. pbrt takes one width at the start of a
//! shape and one at its end, and between them as many steps as there are spans: a strand whose width is constant
//! or runs evenly from point to point (to a thousandth) is one shape, any other one shape a segment.
//!
//! The material is `WriteOptions::look`: absorption, roughness and index as they are (pbrt, too, measures absorption
//! per radius of the fibre). The tilt is written in degrees with its sign turned: a positive `alpha` of pbrt moves
//! R towards the end of the curve, the tip, and ours towards the root, as the scales of hair do
//! (`HairBxDF::f` in `bxdfs.cpp` takes 2 alpha from the outgoing angle, measured towards the curve's end). Without a look it is the mean colour of the strands, as the
//! absorption that gives it at pbrt's own roughness (`HairBxDF::SigmaAFromReflectance`: Chiang et al. 2016,
//! equation 9); without a colour it is pbrt's default.
//!
//! pbrt has no unit and no axis; numbers are kept, and y is what its scenes take for up. Written for pbrt-v4:
//! version 3 calls the type of points `point`. Layout: `Curve::Create` in `shapes.cpp`, `HairMaterial::Create` in
//! `materials.cpp`.

mod material;
mod span;
mod write;

pub(crate) use write::write;
