//! A path tracer for hair: scene, cameras, lights, integrator, film, EXR.
