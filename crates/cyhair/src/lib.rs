//! Reads and writes the HAIR (cyHair) file format to the byte.
