//! Hair scattering after Chiang et al. 2016: evaluate, sample, pdf, albedo.
