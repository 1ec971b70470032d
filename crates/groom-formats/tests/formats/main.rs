//! The tests of every format, in one program: they share most of what has to be compiled.

#[path = "../support/mod.rs"]
mod support;

mod alembic;
mod alembic_foreign;
mod alembic_schema;
mod ct2hair;
mod data;
mod gltf;
mod hair;
mod lines_and_curves;
mod monohair;
mod motion;
mod obj;
mod pbrt;
mod ply;
mod rigged;
mod stream;
mod text;
mod tfx;
mod usd_read;
mod usd_write;
