"""The paper's well: its profile in the vertical plane, and its inclination."""

from reports.figures import Canvas, Figure, Tables, style


def profile(tables: Tables) -> Canvas:
    """Fig. 11: true vertical depth against departure, and inclination against measured depth."""
    table = tables["wells"]
    canvas, (plane, angle) = style.subplots(4.4, 1, 2, width_ratios=(3, 2))
    for index, variant in enumerate(table["variant"].unique()):
        rows = table[table["variant"] == variant]
        plane.plot(rows["departure_m"], rows["tvd_m"], **style.line(index), label=str(variant))
        angle.plot(rows["inclination_deg"], rows["md_m"], **style.line(index))
        bends = style.build_intervals(rows["md_m"].to_numpy(float), rows["inclination_deg"].to_numpy(float))
        ends = rows[rows["md_m"].isin([depth for bend in bends for depth in bend])]
        plane.plot(ends["departure_m"], ends["tvd_m"], **style.dots(index, filled=False))
        angle.plot(ends["inclination_deg"], ends["md_m"], **style.dots(index, filled=False))
    plane.set_aspect("equal", adjustable="datalim")
    plane.set(xlabel="departure along azimuth 45°, m")
    style.depth_downwards(plane, "true vertical depth, m")
    angle.set(xlabel="inclination, °", xticks=[0, 30, 60, 90])
    style.depth_downwards(angle)
    style.legend_above(plane)
    return canvas


FIGURES = [
    Figure(
        "profile",
        "Paper's Fig. 11: the deviated well of the validation, as we read §6.2 (well b: both builds at 16° per 100 m). "
        "Left: its vertical plane at equal scales. Right: inclination along the hole. Marks are ends of builds.",
        profile,
    )
]
