//! Rays against round tapering strands and triangles.
