//! Triangle meshes for grooms to grow on: OBJ and glTF.
