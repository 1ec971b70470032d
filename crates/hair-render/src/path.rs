//! One path of light, from the camera to where it ends.

use glam::Vec3;
use strand_tracing::{Hit, HitKind, Primitive, Ray};

use crate::fibre_hit::FibreHit;
use crate::sampler::Sampler;
use crate::surface::SurfaceHit;
use crate::{Background, LightSampling, RenderSettings, Scene};

/// Passes a sample is kept apart by: the five lobes, surface, background (the order of `Aov::ALL`).
pub(crate) const PARTS: usize = 7;
const LOBES: usize = 5;
const SURFACE: usize = LOBES;
const BACKGROUND: usize = LOBES + 1;

/// What one camera path found.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PathLight {
    pub parts: [Vec3; PARTS],
    pub alpha: f32,
    /// The hair object seen, where it was hair.
    pub fibre: Option<u32>,
}

/// Rays traced, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct RayCounts {
    pub closest: u64,
    pub shadow: u64,
}

/// Traces paths through one scene.
pub(crate) struct PathTracer<'a> {
    scene: &'a Scene,
    settings: &'a RenderSettings,
    next_event: bool,
    transparent_hair: bool,
    pub rays: RayCounts,
}

/// What a ray met, ready to scatter.
enum Vertex<'a> {
    Fibre(Box<FibreHit<'a>>),
    Surface(SurfaceHit),
}

/// A scattering value: a lobe each for a fibre, the first entry alone for a surface.
type Values = [Vec3; LOBES];

fn sum(values: &Values) -> Vec3 {
    values[0] + values[1] + values[2] + values[3] + values[4]
}

/// A surface's value, in the first place.
fn only(value: Vec3) -> Values {
    [value, Vec3::ZERO, Vec3::ZERO, Vec3::ZERO, Vec3::ZERO]
}

/// Places on lights looked at from a fibre before one is chosen. Under soft boxes four take a third off the
/// error of one; eight take little more and cost more than they save.
const FIBRE_CANDIDATES: u32 = 4;

/// Steps between candidates that spread any number of them evenly: Roberts' R3 sequence.
const SPREAD: [f32; 3] = [0.819_172_5, 0.671_043_6, 0.549_700_5];

/// Plain numbers of a dimension set from here on choose among candidates.
const CHOICE: u32 = 1 << 24;

/// Dimension sets of the sampler; each scattering uses three.
const CAMERA_SET: u32 = 0;

fn sets_of(depth: u32) -> [u32; 3] {
    [1 + 3 * depth, 2 + 3 * depth, 3 + 3 * depth]
}

impl<'a> PathTracer<'a> {
    pub fn new(scene: &'a Scene, settings: &'a RenderSettings) -> Self {
        let next_event = settings.light_sampling != LightSampling::ScatteringOnly && scene.lights.shine();
        let transparent_hair = scene.fibres.iter().any(|f| f.may_be_passed());
        PathTracer { scene, settings, next_event, transparent_hair, rays: RayCounts::default() }
    }

    /// The numbers that place a sample on the film.
    pub fn camera_numbers(sampler: &Sampler) -> [f32; 4] {
        sampler.four(CAMERA_SET)
    }

    /// The light that comes back along a camera ray. All of its path is at the ray's moment of the shutter.
    pub fn trace(&mut self, ray: Ray, sampler: &Sampler) -> PathLight {
        let mut light = PathLight::default();
        let hit = self.closest(ray, None, sampler, CAMERA_SET);
        let reach = hit.as_ref().map_or(f32::INFINITY, |hit| hit.t);
        if let Some(radiance) = self.scene.lights.seen_by_camera(ray.origin, ray.direction, reach) {
            // It ends here: what the light does to the scene is found along other paths.
            light.parts[BACKGROUND] = radiance;
            light.alpha = 1.0;
            return light;
        }
        let Some(hit) = hit else {
            if self.settings.background == Background::Visible {
                light.parts[BACKGROUND] = self.scene.lights.environment_radiance(ray.direction);
                light.alpha = 1.0;
            }
            return light;
        };
        light.alpha = 1.0;
        if let Primitive::Segment { object, .. } = hit.primitive {
            light.fibre = Some(object);
        }
        let (first, values) = self.scatter_on(hit, &ray, sampler);
        match first {
            FirstKind::Fibre => light.parts[..LOBES].copy_from_slice(&values),
            FirstKind::Surface => light.parts[SURFACE] = values[0],
        }
        light
    }

    /// Follows the path from its first hit. The first scattering keeps its lobes apart; all that comes
    /// after it is found once and shared by them, so that the parts add up and none is noisier than
    /// the whole.
    fn scatter_on(&mut self, first_hit: Hit, camera_ray: &Ray, sampler: &Sampler) -> (FirstKind, Values) {
        let (mut hit, mut direction, time) = (first_hit, camera_ray.direction, camera_ray.time);
        let mut kind = FirstKind::Surface;
        let mut direct: Values = [Vec3::ZERO; LOBES];
        let mut weights: Values = [Vec3::ZERO; LOBES];
        let mut later = Vec3::ZERO;
        // Relative to the first scattering, whose weight `first_weight` holds.
        let mut throughput = Vec3::ONE;
        let mut first_weight = Vec3::ONE;
        for depth in 0.. {
            let [scatter_set, light_set, pass_set] = sets_of(depth);
            let vertex = self.vertex(&hit, -direction, time);
            if depth == 0 {
                kind = vertex.kind();
            }
            // The first two dimensions are the best spread ones: places on a light get them.
            let [u, v, pick, survive] = sampler.four(light_set);
            let start = vertex.start(&hit);
            if self.next_event {
                let place = Place { start, leaving: hit.primitive, time };
                let found = self.next_event(&vertex, place, [pick, u, v], sampler, pass_set);
                if let Some(found) = found {
                    if depth == 0 {
                        direct = found;
                    } else {
                        later += throughput * sum(&found);
                    }
                }
            }
            let Some((wi, values, pdf)) = vertex.sample(sampler.four(scatter_set)) else { break };
            if depth == 0 {
                weights = values.map(|value| value / pdf);
                first_weight = sum(&weights);
            } else {
                throughput *= sum(&values) / pdf;
            }
            if depth >= self.settings.roulette_start {
                let chance = (throughput * first_weight).max_element().min(1.0);
                if survive >= chance {
                    break;
                }
                throughput /= chance;
            }
            if (throughput * first_weight).max_element() <= 0.0 {
                break;
            }
            let ray = Ray { origin: start, direction: wi, t_max: f32::INFINITY, time };
            let next = self.closest(ray, Some(hit.primitive), sampler, pass_set);
            later += throughput * self.emitted(&ray, pdf, self.candidates(&vertex), next.as_ref());
            match next {
                Some(next) if depth < self.settings.max_bounces => (hit, direction) = (next, wi),
                _ => break,
            }
        }
        let total = std::array::from_fn(|lobe| direct[lobe] + weights[lobe] * later);
        (kind, total)
    }

    fn vertex(&self, hit: &Hit, toward: Vec3, time: f32) -> Vertex<'a> {
        match (hit.kind, hit.primitive) {
            (HitKind::Segment { tangent, h, .. }, Primitive::Segment { object, .. }) => {
                let point = self.scene.fibres[object as usize].point(hit);
                Vertex::Fibre(Box::new(FibreHit::new(point, tangent, h, toward)))
            }
            (_, Primitive::Triangle { object, .. }) => {
                Vertex::Surface(self.scene.surfaces[object as usize].at(hit, toward, time))
            }
            // A hit of one kind on a primitive of the other does not exist; it would be black.
            (_, _) => Vertex::Surface(SurfaceHit::black(toward)),
        }
    }

    /// Light found by choosing a place on a light, weighed against finding it by scattering.
    ///
    /// Several places are drawn from the lights, and one of them is kept by how much light it would
    /// send along the path if nothing were in the way (resampling, Talbot et al. 2005): the scattering
    /// function is cheap beside the one shadow ray that is then traced.
    fn next_event(
        &mut self,
        vertex: &Vertex<'_>,
        place: Place,
        numbers: [f32; 3],
        sampler: &Sampler,
        pass_set: u32,
    ) -> Option<Values> {
        let Place { start, leaving, time } = place;
        let count = self.candidates(vertex);
        let mut chosen = None;
        let mut total = 0.0;
        for (k, step) in (0..count).map(|k| (k, k as f32)) {
            let spread = std::array::from_fn(|d| (numbers[d] + step * SPREAD[d]).fract());
            let Some((candidate, importance)) = self.candidate(vertex, start, spread, count) else {
                continue;
            };
            total += importance;
            if chosen.is_none() || sampler.plain(pass_set, CHOICE + k) * total < importance {
                chosen = Some((candidate, importance));
            }
        }
        let (candidate, importance) = chosen?;
        let ray = Ray { origin: start, direction: candidate.direction, t_max: candidate.distance, time };
        if self.hidden(ray, leaving, sampler, pass_set) {
            return None;
        }
        let weight = total / (importance * count as f32);
        Some(candidate.values.map(|value| value * weight))
    }

    /// How many places on lights are looked at before one is chosen. A fibre's lobes are narrow and cross
    /// the lights anywhere; a matte surface takes light much as it comes, and light that is the same from
    /// everywhere leaves nothing to choose.
    fn candidates(&self, vertex: &Vertex<'_>) -> u32 {
        match vertex {
            Vertex::Fibre(_) if !self.scene.lights.are_even() => FIBRE_CANDIDATES,
            _ => 1,
        }
    }

    /// A place on a light: what it sends along the path when nothing hides it, and that as one number.
    fn candidate(
        &self,
        vertex: &Vertex<'_>,
        start: Vec3,
        numbers: [f32; 3],
        count: u32,
    ) -> Option<(Candidate, f32)> {
        let seen = self.scene.lights.sample(start, numbers)?;
        let (values, scatter_pdf) = vertex.evaluate(seen.direction);
        let weight = match self.settings.light_sampling {
            LightSampling::Both => power_heuristic(count as f32 * seen.pdf, scatter_pdf),
            _ => 1.0,
        };
        let light = seen.radiance * (weight / seen.pdf);
        let values = values.map(|value| value * light);
        let importance = sum(&values).element_sum();
        let candidate = Candidate { direction: seen.direction, distance: seen.distance, values };
        (importance > 0.0).then_some((candidate, importance))
    }

    /// Light met by a scattered ray, weighed against finding it by choosing a place on the light.
    fn emitted(&self, ray: &Ray, scatter_pdf: f32, candidates: u32, hit: Option<&Hit>) -> Vec3 {
        let mut found = Vec3::ZERO;
        let sampling = self.settings.light_sampling;
        if sampling == LightSampling::LightsOnly {
            return found;
        }
        self.scene.lights.along(ray.origin, ray.direction, hit.map(|h| h.t), |radiance, light_pdf| {
            let weight = match sampling {
                LightSampling::Both => power_heuristic(scatter_pdf, candidates as f32 * light_pdf),
                _ => 1.0,
            };
            found += radiance * weight;
        });
        found
    }

    /// The next thing in the way, passing fibres as their transparency has it.
    fn closest(&mut self, ray: Ray, leaving: Option<Primitive>, sampler: &Sampler, set: u32) -> Option<Hit> {
        self.rays.closest += 1;
        let hit = self.scene.tracer.closest(&ray, leaving)?;
        if !self.transparent_hair {
            return Some(hit);
        }
        self.pass_through(ray, hit, sampler, set)
    }

    fn pass_through(&mut self, ray: Ray, hit: Hit, sampler: &Sampler, set: u32) -> Option<Hit> {
        let (mut hit, mut passed) = (hit, 0.0);
        for count in 0.. {
            let Primitive::Segment { object, .. } = hit.primitive else { break };
            let chance = self.scene.fibres[object as usize].transparency(&hit);
            if sampler.plain(set, count) >= chance {
                break;
            }
            passed += hit.t;
            let onward = Ray { origin: hit.position, t_max: ray.t_max - passed, ..ray };
            self.rays.closest += 1;
            hit = self.scene.tracer.closest(&onward, Some(hit.primitive))?;
        }
        Some(Hit { t: hit.t + passed, ..hit })
    }

    fn hidden(&mut self, ray: Ray, leaving: Primitive, sampler: &Sampler, set: u32) -> bool {
        if self.transparent_hair {
            // Other numbers than the scattered ray's: the two must not share their luck.
            return self.closest(ray, Some(leaving), sampler, set | 1 << 31).is_some();
        }
        self.rays.shadow += 1;
        self.scene.tracer.occluded(&ray, Some(leaving))
    }
}

/// What the camera met first.
#[derive(Clone, Copy, Debug)]
enum FirstKind {
    Fibre,
    Surface,
}

/// Where and when a path looks for light.
#[derive(Clone, Copy)]
struct Place {
    start: Vec3,
    leaving: Primitive,
    time: f32,
}

/// A place on a light, as one way to end the path.
struct Candidate {
    direction: Vec3,
    distance: f32,
    values: Values,
}

impl Vertex<'_> {
    fn kind(&self) -> FirstKind {
        match self {
            Vertex::Fibre(_) => FirstKind::Fibre,
            Vertex::Surface(_) => FirstKind::Surface,
        }
    }

    /// Where scattered rays start: on a fibre at the hit (the tracer knows which fibre is left), off a
    /// surface by a few units in the last place, so that its neighbour triangles are not hit.
    fn start(&self, hit: &Hit) -> Vec3 {
        match self {
            Vertex::Fibre(_) => hit.position,
            Vertex::Surface(surface) => {
                let size = hit.position.abs().max_element().max(1e-6);
                hit.position + surface.flat_normal() * (size * 4.0 * f32::EPSILON)
            }
        }
    }

    fn evaluate(&self, wi: Vec3) -> (Values, f32) {
        match self {
            Vertex::Fibre(fibre) => {
                let (values, pdf) = fibre.scatter().evaluate_with_pdf(fibre.to_fibre(wi));
                (values.0, pdf)
            }
            Vertex::Surface(surface) => {
                let (value, pdf) = surface.evaluate(wi);
                (only(value), pdf)
            }
        }
    }

    fn sample(&self, numbers: [f32; 4]) -> Option<(Vec3, Values, f32)> {
        match self {
            Vertex::Fibre(fibre) => {
                let sample = fibre.scatter().sample(numbers)?;
                Some((fibre.to_world(sample.wi), sample.values.0, sample.pdf))
            }
            Vertex::Surface(surface) => {
                let wi = surface.sample(numbers[0], numbers[1]);
                let (value, pdf) = surface.evaluate(wi);
                (pdf > 0.0).then_some((wi, only(value), pdf))
            }
        }
    }
}

/// Veach's power heuristic with exponent 2, for one sample of each kind.
fn power_heuristic(mine: f32, other: f32) -> f32 {
    let ratio = other / mine;
    1.0 / (1.0 + ratio * ratio)
}
