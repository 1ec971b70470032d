//! What is asked of a mesh when it is opened.

/// How [`MovingMesh::open`](crate::MovingMesh::open) reads a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshOptions {
    /// Which of the file's animations moves it (glTF; other formats hold one).
    pub animation: AnimationChoice,
    /// The pose that [`MovingMesh::rest`](crate::MovingMesh::rest) gives.
    pub rest: RestPose,
    /// Frames a second, above 0. OBJ sequences are played at it (else at 24); other files know seconds, and it is
    /// only what [`MovingMesh::frame_rate`](crate::MovingMesh::frame_rate) answers.
    pub frame_rate: Option<f64>,
    /// First and last frame that a bake of a USD stage must cover; `None` takes the stage's own. A frame is a
    /// time code unless there is a [`frame_rate`](MeshOptions::frame_rate). A [`rest`](MeshOptions::rest) at
    /// another time is covered as well, and all that is between.
    pub frames: Option<(f64, f64)>,
    /// Frames between the samples of such a bake, above 0; `None` is 1, less gives sub-frames.
    pub step: Option<f64>,
    /// Whether Z is up, whatever the file says; no number is changed by it.
    pub z_up: Option<bool>,
    /// How many metres a unit has, above 0, whatever the file says; no number is changed by it.
    pub meters_per_unit: Option<f64>,
}

/// The pose a groom was made for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum RestPose {
    /// Skinned glTF meshes as they were modelled (their skin moves nothing), UsdSkel meshes as they were bound,
    /// every other mesh as [`RestPose::Nodes`].
    #[default]
    Bind,
    /// As the file stands without any animation: the transforms of its nodes, its skins, its default morph
    /// weights. A sequence has no such pose and takes its first frame, and so does a USD mesh without a value
    /// outside its time samples; UsdSkel meshes are as in [`RestPose::Bind`].
    Nodes,
    /// As it is at this time, in seconds.
    Time(f64),
}

impl RestPose {
    pub(crate) fn time(self) -> Option<f64> {
        match self {
            RestPose::Time(time) => Some(time),
            RestPose::Bind | RestPose::Nodes => None,
        }
    }
}

/// One of a file's animations.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum AnimationChoice {
    /// The first, if there is one.
    #[default]
    First,
    /// None: the mesh stays as it is.
    None,
    /// The first of this name.
    Name(String),
    /// By number, counted from 0.
    Index(usize),
}

/// An animation of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Animation {
    /// Its name; empty when it has none.
    pub name: String,
    /// Time of its first key in seconds.
    pub start: f64,
    /// Time of its last key in seconds.
    pub end: f64,
}
