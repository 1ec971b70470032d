//! The arrays of a file: what is in each, in the order it is written.

use glam::Vec3;
use gltf::json::Value;
use gltf::json::accessor::{ComponentType, Type};
use gltf::mesh::Semantic;

use super::Plan;
use super::extra::Extra;
use super::skin::Skin;
use super::surface::Surface;

/// One array of the buffer: equal elements one after the other, each of one or several fields.
pub(super) struct View<'a> {
    pub(super) content: Content<'a>,
    pub(super) count: usize,
    /// Bytes of an element, a multiple of 4.
    pub(super) stride: usize,
    pub(super) fields: Vec<Field>,
}

impl View<'_> {
    pub(super) fn bytes(&self) -> u64 {
        self.count as u64 * self.stride as u64
    }
}

/// What is written into an array.
#[derive(Clone, Copy)]
pub(super) enum Content<'a> {
    /// Two indices a segment.
    Lines,
    /// Indices of tubes and ribbons.
    Triangles,
    /// Vertices of tubes and ribbons, all fields side by side.
    Surface,
    Positions,
    Colors,
    Widths,
    Extra(Extra<'a>),
    Joints,
    Weights,
}

/// A field of an element.
pub(super) struct Field {
    /// `None` for indices.
    pub(super) semantic: Option<Semantic>,
    pub(super) offset: usize,
    pub(super) component: ComponentType,
    pub(super) kind: Type,
    pub(super) normalized: bool,
    /// Exact bounds, which POSITION must have.
    pub(super) bounds: Option<[Value; 2]>,
}

impl Field {
    pub(super) fn new(semantic: Option<Semantic>, component: ComponentType, kind: Type) -> Self {
        Field { semantic, offset: 0, component, kind, normalized: false, bounds: None }
    }

    /// POSITION of points inside `bounds`, and its bytes.
    fn position(plan: &Plan<'_>) -> (Self, usize) {
        let semantic = Some(Semantic::Positions);
        match plan.grid.filter(|grid| grid.is_stored()) {
            Some(grid) => {
                let corners = plan.bounds.map(|corner| numbers(grid.stored(corner).map(f64::from)));
                let field = Field::new(semantic, ComponentType::U16, Type::Vec3);
                (Field { normalized: true, bounds: Some(corners), ..field }, 8)
            }
            None => {
                let snapped = |corner: Vec3| plan.grid.map_or(corner, |grid| grid.rounded(corner));
                let corners = plan.bounds.map(|corner| numbers(snapped(corner).to_array().map(f64::from)));
                let field = Field::new(semantic, ComponentType::F32, Type::Vec3);
                (Field { bounds: Some(corners), ..field }, 12)
            }
        }
    }
}

fn numbers(values: [f64; 3]) -> Value {
    Value::from(values.to_vec())
}

/// The arrays of lines.
pub(super) fn of_lines<'a>(plan: &Plan<'a>, extras: &[(String, Extra<'a>)]) -> Vec<View<'a>> {
    let points = plan.drawable.points;
    let indices = View {
        content: Content::Lines,
        count: 2 * (points - plan.drawable.strands),
        stride: 4,
        fields: vec![Field::new(None, ComponentType::U32, Type::Scalar)],
    };
    let (position, stride) = Field::position(plan);
    let positions = View { content: Content::Positions, count: points, stride, fields: vec![position] };
    let mut views = vec![indices, positions];
    if plan.colors.is_some() {
        let field = Field::new(Some(Semantic::Colors(0)), ComponentType::U8, Type::Vec4);
        let fields = vec![Field { normalized: true, ..field }];
        views.push(View { content: Content::Colors, count: points, stride: 4, fields });
    }
    let width = Field::new(Some(Semantic::Extras("WIDTH".to_owned())), ComponentType::F32, Type::Scalar);
    views.push(View { content: Content::Widths, count: points, stride: 4, fields: vec![width] });
    views.extend(extras.iter().map(|(name, extra)| of_extra(name, *extra, points)));
    views
}

/// The arrays of tubes or ribbons.
pub(super) fn of_surface<'a>(
    plan: &Plan<'a>,
    surface: &Surface<'_>,
    extras: &[(String, Extra<'a>)],
) -> Vec<View<'a>> {
    let indices = View {
        content: Content::Triangles,
        count: surface.index_count(plan.drawable),
        stride: 4,
        fields: vec![Field::new(None, ComponentType::U32, Type::Scalar)],
    };
    let count = plan.drawable.points * surface.per_point();
    let (position, mut stride) = Field::position(plan);
    let mut fields = vec![position];
    let mut add = |semantic, component, kind, bytes: usize| {
        let field = Field::new(Some(semantic), component, kind);
        let normalized = component == ComponentType::U8;
        fields.push(Field { offset: stride, normalized, ..field });
        stride += bytes;
    };
    add(Semantic::Normals, ComponentType::F32, Type::Vec3, 12);
    add(Semantic::TexCoords(0), ComponentType::F32, Type::Vec2, 8);
    if plan.colors.is_some() {
        add(Semantic::Colors(0), ComponentType::U8, Type::Vec4, 4);
    }
    let mut views = vec![indices, View { content: Content::Surface, count, stride, fields }];
    views.extend(extras.iter().map(|(name, extra)| of_extra(name, *extra, count)));
    views
}

/// What a skin asks of every vertex.
pub(super) fn of_skin<'a>(skin: &Skin<'_>, count: usize) -> [View<'a>; 2] {
    let (component, stride) = if skin.is_wide() { (ComponentType::U16, 8) } else { (ComponentType::U8, 4) };
    let joints = vec![Field::new(Some(Semantic::Joints(0)), component, Type::Vec4)];
    let weights = vec![Field::new(Some(Semantic::Weights(0)), ComponentType::F32, Type::Vec4)];
    [
        View { content: Content::Joints, count, stride, fields: joints },
        View { content: Content::Weights, count, stride: 16, fields: weights },
    ]
}

fn of_extra<'a>(name: &str, extra: Extra<'a>, count: usize) -> View<'a> {
    let (kind, stride) = extra.shape();
    let semantic = Semantic::Extras(name.trim_start_matches('_').to_owned());
    let fields = vec![Field::new(Some(semantic), ComponentType::F32, kind)];
    View { content: Content::Extra(extra), count, stride, fields }
}
