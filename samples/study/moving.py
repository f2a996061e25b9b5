"""Draws a run at steady speed as a moving picture: ridges and their force pass under the stylus, slowed down.
usage: moving.py RUN.csv OUT.svg     RUN.csv: of knurl run --out; its ridges are 1 mm apart

SPDX-License-Identifier: MIT
"""
import csv
import sys

RIDGE = 1e-3     # m
LOOP = 8         # ridges a round
SHOWN = 12       # ridges in sight
SECONDS = 6.4    # a round
MM = 50          # px a ridge
LEFT, RIGHT, TIP = 60, 60 + SHOWN * MM, 60 + SHOWN * MM // 2
SURFACE, HEIGHT = 245, 55e3   # px; px a m of height
ZERO, NEWTON = 150, 200       # px; px a N

CSS = """
.back{fill:#fff}.ink{fill:#1c2b33}.grey{fill:#77858c}.rule{stroke:#c3ccd0}.plate{fill:#8cc3cb}.force{stroke:#0f6e84}
.pen{stroke:#1c2b33}.dot{fill:#d9662b}.arrow{stroke:#d9662b}
text{font:13px DejaVu Sans,Verdana,sans-serif}.title{font-size:17px;font-weight:bold}
@media(prefers-color-scheme:dark){.back{fill:#0d1117}.ink{fill:#e6edf3}.grey{fill:#9198a1}.rule{stroke:#3d444d}
.plate{fill:#1d5964}.force{stroke:#5fb0bb}.pen{stroke:#e6edf3}}
@media(prefers-reduced-motion){.scroll,.rides,.pushes{animation:none!important}}
"""


def read(path):
    """(x, height, force along y) of the last ticks, LOOP + SHOWN ridges long."""
    with open(path, encoding="utf-8") as file:
        rows = [(float(row["x"]), float(row["height"]), float(row["fy"])) for row in csv.DictReader(file)]
    begin = rows[-1][0] - (LOOP + SHOWN) * RIDGE
    rows = [(x - begin, height, force) for x, height, force in rows if x >= begin]
    if rows[0][0] > 0.1 * RIDGE or min(force for *_, force in rows) <= 0.0:
        sys.exit(f"{path}: expected contact over the last {LOOP + SHOWN} mm, found less")
    return rows


def steps(rows, value):
    """The points of a line that holds each tick's value until the next."""
    last = None
    for x, *values in rows:
        y = value(*values)
        if y != last:
            at = LEFT + x / RIDGE * MM
            yield from ((at, last),) if last is not None else ()
            yield at, y
        last = y
    yield LEFT + (LOOP + SHOWN) * MM, last


def path(points):
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)


def frames(name, rows, declaration):
    """Keyframes of the stylus: those ticks at which something changes."""
    half, found, last = SHOWN * RIDGE / 2, [], None
    for x, *values in rows:
        share = (x - half) / (LOOP * RIDGE)
        told = declaration(*values)
        if 0.0 <= share <= 1.0 and told != last:
            found.append(f"{100 * share if found else 0:.2f}%{{{told}}}")
            last = told
    return f"@keyframes {name}{{{''.join(found)}}}"


def main(source, out):
    rows = read(source)
    force = [force for *_, force in rows]
    animations = [f"@keyframes scroll{{to{{transform:translateX({-LOOP * MM}px)}}}}",
                  frames("rides", rows, lambda height, _: f"transform:translateY({-HEIGHT * height:.1f}px)"),
                  frames("pushes", rows, lambda _, force: f"transform:translateY({-NEWTON * force:.1f}px)"),
                  f".scroll{{animation:scroll {SECONDS}s linear infinite}}",
                  f".rides{{animation:rides {SECONDS}s step-end infinite}}.pushes{{animation:pushes {SECONDS}s step-end infinite}}"]
    plate = path(steps(rows, lambda height, _: SURFACE - HEIGHT * height)) + f"V300H{LEFT}Z"
    trace = path(steps(rows, lambda _, force: ZERO - NEWTON * force))
    marks = "".join(f'<text class="grey" x="{LEFT - 8}" y="{ZERO - NEWTON * n + 4:.0f}" text-anchor="end">{n:g} N</text>'
                    f'<path class="rule" d="M{LEFT} {ZERO - NEWTON * n:.0f}H{RIGHT}"/>' for n in (0.0, 0.2, 0.4))
    svg = f"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {RIGHT + 20} 310" role="img">
<title>1 mm ridges under a moving hand, and the force on it</title>
<style>{CSS}{"".join(animations)}</style>
<clipPath id="sight"><path d="M{LEFT} 0H{RIGHT}V300H{LEFT}Z"/></clipPath>
<path class="back" d="M0 0H{RIGHT + 20}V310H0Z"/>
<text class="title ink" x="{LEFT}" y="24">1 mm ridges under a moving hand</text>
<text class="grey" x="{LEFT}" y="43">50 mm/s, 40 times slower; the force is {min(force):.2f} to {max(force):.2f} N, a new one each millisecond</text>
{marks}
<g clip-path="url(#sight)"><g class="scroll"><path class="plate" d="{plate}"/>
<path class="force" fill="none" stroke-width="2" d="{trace}"/></g></g>
<g class="rides"><path class="pen" stroke-width="7" stroke-linecap="round" d="M{TIP} {SURFACE - 6}L{TIP + 26} {SURFACE - 62}"/>
<circle class="dot" cx="{TIP}" cy="{SURFACE - 4}" r="4"/></g>
<g class="pushes"><circle class="dot" cx="{TIP}" cy="{ZERO}" r="5"/></g>
<path class="arrow" stroke-dasharray="2 4" d="M{TIP} {SURFACE}V{ZERO}"/>
</svg>
"""
    with open(out, "w", encoding="utf-8") as file:
        file.write(svg)


if __name__ == "__main__":
    main(*sys.argv[1:])
