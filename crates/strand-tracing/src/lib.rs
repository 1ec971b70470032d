//! Rays against round tapering strands and triangles.
//!
//! A strand is the union of the cone-spheres between its points: the convex hull of a sphere round each
//! end of a segment, so joints have no gaps and no leaks. [`Tracer::closest`] finds the first point where
//! a ray ENTERS that union (or crosses a triangle, from either side); [`Tracer::occluded`] only asks
//! whether there is one. Scattering and light are not this crate's business.
//!
//! # Leaving a fibre
//!
//! Fibres scatter in the near field: light comes out where it went in, so a scattered ray may start at the
//! hit point and run through the fibre itself. Pass the primitive it leaves as `leaving`: the ray does not
//! see that segment, nor any part of the same strand before it has come out of it. No ray is offset and
//! there is no epsilon in world units; a curl that comes back to itself is hit. A triangle left is not hit
//! again, nor is its neighbour where only the rounding of the origin puts the ray behind it.
//!
//! # Motion
//!
//! Points and vertices may be given at several keys of a shutter ([`Strands::moved`], [`Triangles::moved`]),
//! and every ray has a [time](Ray::time) in it. A ray sees the scene as a still one of the positions at its
//! time, each interpolated between two keys and rounded once: hit for hit, bit for bit. A ray that leaves a
//! hit has the hit's time.
//!
//! ```
//! use glam::{Vec3, vec3};
//! use strand_tracing::{BuildOptions, HitKind, Radii, Ray, Strands, Tracer};
//!
//! let positions = [vec3(-1.0, 0.0, 0.0), vec3(0.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0)];
//! let radii = Radii::Constant(0.01);
//! let hair = Strands { offsets: &[0, 3], positions: &positions, radii, moved: &[] };
//! let tracer = Tracer::build(&[hair], &[], &BuildOptions::default())?;
//!
//! let origin = vec3(0.5, 0.005, 2.0);
//! let ray = Ray { origin, direction: Vec3::NEG_Z, t_max: f32::INFINITY, time: 0.0 };
//! let hit = tracer.closest(&ray, None).ok_or("missed")?;
//! let HitKind::Segment { h, .. } = hit.kind else { return Err("not hair".into()) };
//! assert!((h.abs() - 0.5).abs() < 1e-4);
//!
//! let onward = Ray { origin: hit.position, ..ray };
//! assert!(!tracer.occluded(&onward, Some(hit.primitive)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arrange;
mod bounds;
mod build;
mod cone_sphere;
mod error;
mod fibres;
mod hit;
mod input;
mod inside;
mod intervals;
mod keys;
mod line;
mod meshes;
mod moving;
mod moving_packs;
mod moving_pieces;
mod moving_tree;
mod moving_triangles;
mod pack;
mod pieces;
mod pose;
mod query;
mod search;
mod shares;
mod slabs;
mod stray;
mod tracer;
mod tracks;
mod triangle;
mod walk;
mod wide_tree;

pub use error::TracingError;
pub use hit::{Hit, HitKind, Primitive, Ray};
pub use input::{BuildOptions, BuildQuality, Radii, Strands, Triangles};
pub use tracer::{Statistics, Tracer};
