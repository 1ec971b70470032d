//! Holds a fibre's scattering against the laws it must obey, and says what it found.
