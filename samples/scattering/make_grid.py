"""Writes grid.csv: a small table of fibres and directions for `fibre-check eval`."""

import itertools

SETS = {
    "blond": dict(beta_m=0.3, beta_n=0.3, alpha_deg=2, eta=1.55, sigma=(0.06, 0.1, 0.2)),
    "smooth black": dict(beta_m=0.1, beta_n=0.2, alpha_deg=3, eta=1.55, sigma=(3.35, 5.58, 10.96)),
    "white": dict(beta_m=0.6, beta_n=0.6, alpha_deg=0, eta=1.55, sigma=(0, 0, 0)),
}
THETA_O, H, THETA_I, PHI = (0, 40), (-0.5, 0.9), (-60, -38, 5), (-120, 0, 60, 175)

with open(__file__.replace("make_grid.py", "grid.csv"), "w", newline="") as file:
    file.write("set,beta_m,beta_n,alpha_deg,eta,sigma_r,sigma_g,sigma_b,theta_o_deg,h,theta_i_deg,phi_deg\n")
    for name, s in SETS.items():
        for angles in itertools.product(THETA_O, H, THETA_I, PHI):
            cells = [name, s["beta_m"], s["beta_n"], s["alpha_deg"], s["eta"], *s["sigma"], *angles]
            file.write(",".join(map(str, cells)) + "\n")
