//! Alembic archives in the Ogawa layout, to the byte, read and written.
