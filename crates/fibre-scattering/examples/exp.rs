#![allow(clippy::unwrap_used)]
#[path = "../tests/brute_force/mod.rs"]
mod brute_force;
use brute_force::*;
use fibre_scattering::*;
use std::sync::Arc;
use std::time::Instant;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let walks: u32 = args.get(1).map_or(0, |a| a.parse().unwrap());
    let n: usize = args.get(2).map_or(100_000, |a| a.parse().unwrap());
    let others = [
        Cylinders { eta: 1.55, kappa: 0.5, sigma_s: 3.0, g: 0.5, layers: None },
        Cylinders { eta: 1.55, kappa: 0.95, sigma_s: 100.0, g: 0.9, layers: None },
        Cylinders { eta: 1.55, kappa: 0.9, sigma_s: 100.0, g: -0.5, layers: None },
        Cylinders { eta: 1.55, kappa: 0.3, sigma_s: 0.01, g: 0.99, layers: None },
    ];
    for (name, c) in [
        ("A", SET_A),
        ("B", SET_B),
        ("K5", others[0]),
        ("thick", others[1]),
        ("thickb", others[2]),
        ("thin", others[3]),
    ] {
        let mut p = FurParameters::default();
        p.hair.eta = c.eta as f32;
        p.medulla =
            Medulla { kappa: c.kappa as f32, sigma_s: c.sigma_s as f32, g: c.g as f32, ..Medulla::NONE };
        let mut key = MedullaKey::needed(&p).unwrap();
        key.walks = walks;
        let t = Instant::now();
        let table = Arc::new(MedullaTable::build(&key).unwrap());
        println!(
            "{name}: walks {} build {:.2} s cpu, {} bytes",
            key.walks_per_row(),
            t.elapsed().as_secs_f64(),
            table.size()
        );
        let fur = FurReference::new(&p, Some(table)).unwrap();
        let absorptions = [
            [0.0, 0.0],
            [0.4, 0.0],
            [0.0, 0.2],
            [0.39, 0.21],
            [0.05, 0.05],
            [3.0, 0.0],
            [0.0, 2.0],
            [5.0, 5.0],
        ];
        for theta in [0.0_f64, 20.0, 45.0, 75.0] {
            for h in [0.0, 0.31, 0.77, 0.95] {
                let (s, co) = theta.to_radians().sin_cos();
                let wo = [s, co, 0.0];
                let mut chance = Chance::new(5);
                let mut sums = [0.0; 8];
                let mut l1 = vec![0.0; 24 * 8];
                let mut scat = 0.0;
                let mut dens = vec![0.0; 24 * 8];
                for _ in 0..n {
                    let o = c.walk(wo, h, &mut chance);
                    for (sum, a) in sums.iter_mut().zip(absorptions) {
                        *sum += o.passed(a) / n as f64;
                    }
                    if o.scatterings > 0 {
                        scat += 1.0;
                        let phi = o.way[2].atan2(o.way[1]).rem_euclid(std::f64::consts::TAU);
                        let i = ((phi / std::f64::consts::TAU * 24.0) as usize).min(23);
                        let j = ((o.way[0] + 1.0) * 4.0) as usize;
                        l1[i * 8 + j.min(7)] += 1.0;
                    }
                }
                let hit = fur.at(wo, h);
                // table density on the same bins
                let mut tot = 0.0;
                for i in 0..24 * 6 {
                    for j in 0..8 * 6 {
                        let phi = (i as f64 + 0.5) / 144.0 * std::f64::consts::TAU;
                        let s = (j as f64 + 0.5) / 24.0 - 1.0;
                        let c = (1.0 - s * s).sqrt();
                        let v = hit.evaluate_with_pdf([s, c * phi.cos(), c * phi.sin()]).0[4][0];
                        dens[i / 6 * 8 + j / 6] += v;
                        tot += v;
                    }
                }
                let d: f64 = l1.iter().zip(&dens).map(|(a, b)| (a / scat - b / tot).abs()).sum();
                let s8: Vec<String> = absorptions
                    .iter()
                    .zip(sums)
                    .map(|(a, sum)| {
                        let al: f64 = fur
                            .at_absorbing(wo, h, [[a[0]; 3], [a[1]; 3]])
                            .albedo()
                            .iter()
                            .map(|l| l[0])
                            .sum();
                        format!("{:+.2}%", (al / sum - 1.0) * 100.0)
                    })
                    .collect();
                println!(
                    "  th {theta} h {h}: S {:.3} L1 {d:.3} albedo {:.3} {:.3} {:.3} err {}",
                    scat / n as f64,
                    sums[3],
                    sums[5],
                    sums[7],
                    s8.join(" ")
                );
            }
        }
    }
}
