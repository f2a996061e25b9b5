"""The picture of the architecture, an SVG: modules, their units, and an arrow from each user to the module that it
uses. Positions are defined here; modules and arrows come from the code. SPDX-License-Identifier: MIT"""
from xml.sax.saxutils import escape

PATH = "assets/pictures/architecture.svg"
WIDTH, HEIGHT = 944, 980
BOX = 40  # height of a box with a title and a line below it

# Module: left, top, right, bottom, its purpose. Modules without boxes list their units.
MODULES = {
    "loop": (16, 72, 304, 146, "the 1 kHz thread: read, tick, write"),
    "audio": (316, 72, 510, 146, "a tick, heard and felt"),
    "gltf": (518, 72, 928, 146, "a file becomes a scene"),
    "device": (16, 178, 146, 456, "any device"),
    "scene": (172, 178, 928, 508, "folders surface, proxy, guard, hip, scene, stroke"),
    "motion": (16, 472, 146, 566, "positions to speeds"),
    "contact": (172, 550, 752, 886, "contact with one surface"),
    "grating": (782, 550, 928, 666, "a height from a speed"),
    "vibration": (782, 690, 928, 774, "square waves in time"),
    "base": (16, 896, 928, 964, "used by all modules"),
}
# Modules that are drawn as one, for their boxes are.
TOGETHER = {"scene": ("surface", "proxy", "guard", "hip", "scene", "stroke")}
# Position of the arrow between two modules: x, or y if they are side by side. Boxes in a module have their own arrows
# to boxes in other modules.
MODULE_ARROWS = {("gltf", "scene"): 860, ("loop", "device"): 81, ("loop", "scene"): 230, ("audio", "scene"): 393, ("scene", "motion"): 482, ("scene", "device"): 300,
                 ("scene", "grating"): 855, ("grating", "vibration"): 855}

# Box: its middle, its top, its width, its title, the line below it, the units in it.
BOXES = {
    "tick": (675, 206, 330, "tick", "the steps below, one by one", ["scene/tick"]),
    "edits": (330, 206, 180, "edits, queries", "from other threads",
              ["scene/edit", "scene/check", "scene/scene_hips", "scene/surface_info", "scene/surface_queries",
               "scene/find_closest", "stroke/walk", "stroke/lay"]),
    "state": (675, 288, 100, "scene, hip", "the state", ["scene/scene", "hip/hip", "hip/hip_workspace", "hip/response"]),
    "broad_phase": (238, 372, 108, "broad_phase", "nearby surfaces", ["surface/broad_phase"]),
    "candidates": (363, 372, 108, "candidates", "surfaces in reach", ["proxy/candidate", "proxy/candidates", "proxy/hip_clock"]),
    "contact_update": (488, 372, 108, "contact_update", "begin, hold, end", ["proxy/contact_update"]),
    "force_law": (613, 372, 108, "force_law", "F = K (H - z)", ["hip/effects", "hip/even", "hip/force_law", "hip/friction", "hip/response"]),
    "guard": (738, 372, 108, "guard", "limits, heat", ["guard/guard", "guard/last_stage"]),
    "snapshot": (863, 372, 108, "snapshot", "for other threads", ["hip/snapshot"]),
    "limits": (738, 456, 190, "wall, passivity", "unstable walls", ["guard/wall", "guard/passivity", "guard/hip_facts"]),
    "joint": (270, 456, 130, "joint_contact", "where surfaces meet",
              ["proxy/joint_contact", "proxy/joint_search", "proxy/joint_faces", "proxy/god_object",
               "proxy/active_faces", "proxy/obstacles", "proxy/contacts", "proxy/active_contact", "proxy/felt",
               "proxy/felt_parts"]),
    "surfaces": (492, 456, 270, "surfaces", "shape, material, motion",
                 ["surface/surfaces", "surface/surface", "surface/surface_frame", "surface/record", "surface/pose",
                  "surface/epoch"]),
    "shape": (462, 578, 210, "shape", "a plane or a mesh", ["contact/shape"]),
    "make_plane": (270, 644, 160, "plane_from_mesh", "a sheet and its outline",
                   ["contact/plane_from_mesh", "contact/outline", "contact/outline_overlap", "contact/edge_table",
                    "contact/sheet", "contact/sheet_coordinates"]),
    "make_mesh": (462, 644, 160, "mesh_build", "weld, adjacency",
                  ["contact/mesh_build", "contact/mesh_adjacency", "contact/weld", "contact/seeded_hash",
                   "contact/mesh_touch", "contact/mesh_winding", "contact/uv_scale"]),
    "mesh_contact": (654, 644, 160, "mesh_contact", "the proxy on a mesh", ["contact/mesh_contact"]),
    "plane": (270, 702, 160, "plane", "z = 0 in an outline", ["contact/plane", "contact/plane_hold"]),
    "mesh_frame": (462, 702, 160, "mesh_frame", "x, y, coordinates", ["contact/mesh_frame", "contact/projection"]),
    "mesh_feel": (462, 760, 160, "mesh_feel", "curved patches", ["contact/mesh_feel", "contact/patch", "contact/mesh_normals", "contact/mesh_crease", "contact/mesh_facets"]),
    "mesh_walk": (654, 702, 160, "mesh_walk", "downhill to the nearest", ["contact/mesh_walk"]),
    "mesh_query": (654, 760, 160, "mesh_query", "nearest point, crossing", ["contact/mesh_query", "contact/mesh_cast", "contact/mesh_search",
                   "contact/leaf_bound"]),
    "contact": (254, 818, 128, "contact", "query and result", ["contact/contact", "contact/visits", "contact/shape_facts"]),
    "bvh": (390, 818, 104, "bvh", "a tree of boxes", ["contact/bvh", "contact/bvh_search", "contact/float4"]),
    "mesh": (516, 818, 108, "mesh, corner", "a corner table", ["contact/mesh", "contact/corner"]),
    "closest_point": (665, 818, 138, "closest_point", "of one triangle", ["contact/closest_point", "contact/facet"]),
}
# The path of a force: the modules of a tick's steps, in order.
WAY = ["device", "loop", "tick", "motion", "broad_phase", "candidates", "contact_update", "contact", "force_law",
       "grating", "vibration", "guard", "snapshot"]
LEGEND = ["1 to 13: the path of", "a force; then back", "to the device", "", "blue: what a tick runs", "", "arrow: uses"]

STYLE = """
text { font: 12px system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; fill: #1f2328; }
.small { font-size: 11px; fill: #59636e; } .title { font-weight: 600; font-size: 14px; } .middle { text-anchor: middle; }
.paper { fill: #ffffff; } .module { fill: #f3f5f8; stroke: #c9d1d9; } .box { fill: #ffffff; stroke: #8c959f; }
.tick { fill: #e8f2ff; stroke: #0969da; stroke-width: 1.4; } .arrow { fill: none; stroke: #6e7781; stroke-width: 1.3; }
.call { stroke: #0969da; stroke-width: 1.6; } .head { fill: #6e7781; } .callhead { fill: #0969da; }
.badge { fill: #0969da; } .number { fill: #ffffff; font-size: 10px; font-weight: 700; text-anchor: middle; }
@media (prefers-color-scheme: dark) {
text { fill: #e6edf3; } .small { fill: #9da7b1; } .paper { fill: #0d1117; } .module { fill: #161b22; stroke: #30363d; }
.box { fill: #21262d; stroke: #6e7681; } .tick { fill: #0c2d55; stroke: #4493f8; } .arrow { stroke: #8b949e; }
.call { stroke: #4493f8; } .head { fill: #8b949e; } .callhead { fill: #4493f8; } .badge { fill: #4493f8; }
.number { fill: #0d1117; } }
"""


def units_of(code, module):
    return [unit for part in TOGETHER.get(module, (module,)) for unit in code.units_of(part)]


def reduced(uses):
    """Without the arrows that others imply (a graph without circles)."""
    below = {}

    def reach(node):
        if node not in below:
            below[node] = set()
            for other in uses[node]:
                below[node] |= {other} | reach(other)
        return below[node]

    return {node: {other for other in others if not any(other in reach(third) for third in others - {other})}
            for node, others in uses.items()}


def between(code, groups):
    """Arrows between groups of units, as {name: names}."""
    of = {unit: name for name, units in groups.items() for unit in units}
    uses = {name: set() for name in groups}
    for unit, name in of.items():
        uses[name] |= {of[other] for other in code.uses.get(unit, ()) if of.get(other, name) != name}
    return uses


def wrap(words, width):
    """Lines of at most `width` letters."""
    lines = [""]
    for word in words:
        if lines[-1] and len(lines[-1]) + 2 + len(word) > width:
            lines[-1] += ","
            lines.append("")
        lines[-1] += (", " if lines[-1] else "") + word
    return lines


class Svg:
    def __init__(self):
        self.parts = []

    def text(self, x, y, text, kind):
        self.parts.append(f'<text x="{x:g}" y="{y:g}" class="{kind}">{escape(text)}</text>')

    def rectangle(self, left, top, right, bottom, kind, radius):
        self.parts.append(f'<rect x="{left:g}" y="{top:g}" width="{right - left:g}" height="{bottom - top:g}" '
                          f'rx="{radius}" class="{kind}"/>')

    def arrow(self, path, kind):
        self.parts.append(f'<path d="{path}" class="arrow {kind}" marker-end="url(#{kind or "use"})"/>')

    def badge(self, x, y, number):
        self.parts.append(f'<circle cx="{x:g}" cy="{y:g}" r="8.5" class="badge"/>')
        self.text(x, y + 3.6, str(number), "number")


def ports(names, middle, width, other):
    """The x of arrows on a box's edge, in the order of their other ends."""
    names = sorted(names, key=lambda name: (other(name), name))
    gap = min(66.0, width / max(1, len(names)))
    return {name: middle + gap * (i - (len(names) - 1) / 2) for i, name in enumerate(names)}


def draw_arrows(svg, uses, kinds):
    down = {name: [other for other in others if BOXES[other][1] > BOXES[name][1]] for name, others in uses.items()}
    starts = {name: ports(others, BOXES[name][0], BOXES[name][2], lambda other: BOXES[other][0])
              for name, others in down.items()}
    ends = {name: ports([user for user in down if name in down[user]], BOXES[name][0], BOXES[name][2],
                        lambda user: BOXES[user][0]) for name in BOXES}
    for name, others in sorted(uses.items()):
        x, top, width = BOXES[name][:3]
        for other in sorted(others):
            to, to_top, to_width = BOXES[other][:3]
            kind = kinds.get((name, other), "")
            if to_top > top:
                a, b = starts[name][other], ends[other][name]
                bend = 0.5 * (to_top - top - BOX)
                svg.arrow(f"M{a:g} {top + BOX} C{a:g} {top + BOX + bend:g} {b:g} {to_top - bend:g} {b:g} {to_top - 2}", kind)
            elif any(min(x, to) < BOXES[third][0] < max(x, to) and BOXES[third][1] == top for third in BOXES):
                svg.arrow(f"M{x:g} {top + BOX} C{x:g} {top + BOX + 28} {to:g} {top + BOX + 28} {to:g} {top + BOX + 2}", kind)
            else:
                side = 1 if to > x else -1
                svg.arrow(f"M{x + side * width / 2:g} {top + BOX / 2} L{to - side * (to_width / 2 + 2):g} {top + BOX / 2}",
                          kind)


def draw_modules(svg, code):
    """Returns those whose list is too long."""
    full = []
    for module, (left, top, right, bottom, about) in MODULES.items():
        svg.rectangle(left, top, right, bottom, "module", 8)
        narrow = right - left < 200
        svg.text(left + 12, top + 20, module, "title")
        svg.text(left + 12 if narrow else left + 24 + 8 * len(module), top + (37 if narrow else 20), about, "small")
        if module in ("scene", "contact"):
            continue
        names = dict.fromkeys(unit.split("/")[1] for unit in units_of(code, module))  # a driver's files are one
        y = top + (58 if narrow else 38)
        for line in wrap(names, int((right - left - 20) / 6.4)):
            svg.text(left + 12, y, line, "")
            y += 15
        full += [module] if y - 10 > bottom else []
    return full


def draw_module_arrows(svg, modules):
    for module, others in modules.items():
        for other in sorted(others):
            at, y, to = MODULE_ARROWS[module, other], MODULES[module][3], MODULES[other][1]
            if to > y:
                svg.arrow(f"M{at} {y} L{at} {to - 2}", "")
            else:
                svg.arrow(f"M{MODULES[module][0]} {at} L{MODULES[other][2] + 2} {at}", "")


def draw(code):
    """The picture's text, and the units that it has no place for."""
    missing = [f"picture.py: {unit} has no box" for module in ("scene", "contact") for unit in units_of(code, module)
               if not any(unit in box[5] for box in BOXES.values())]
    missing += [f"picture.py: there is no {unit}" for box in BOXES.values() for unit in box[5] if unit not in code.uses]
    boxes = between(code, {name: box[5] for name, box in BOXES.items()})
    modules = reduced(between(code, {module: units_of(code, module) for module in MODULES if module != "base"}))
    modules["gltf"] |= {"scene"} & set().union(*(code.public[path] for path in code.public if "/gltf/" in path))
    modules["audio"] |= {"scene"}  # a tick's output, from the public header
    modules["scene"].discard("contact")  # from box to box
    missing += [f"picture.py: no place for the arrow from {module} to {other}" for module in modules for other in modules[module]
                if (module, other) not in MODULE_ARROWS]
    if missing:
        return "", missing
    steps = boxes["tick"] & set(WAY)
    arrows = reduced(boxes)
    arrows["tick"] |= steps
    svg = Svg()
    svg.rectangle(0, 0, WIDTH, HEIGHT, "paper", 10)
    svg.rectangle(16, 16, WIDTH - 16, 50, "module", 8)
    svg.text(28, 38, "bindings, samples, the knurl tool", "title")
    svg.text(310, 38, "use all modules, by their public headers alone: <knurl/...>", "small")
    for i, line in enumerate(LEGEND):
        svg.text(20, 580 + 16 * i, line, "small")
    missing += [f"picture.py: the list of {module} is longer than its box" for module in draw_modules(svg, code)]
    draw_module_arrows(svg, modules)
    draw_arrows(svg, arrows, {("tick", step): "call" for step in steps})
    runs = code.nonblocking | {"scene/tick"}  # its mark is in the public header
    for name, (x, top, width, title, about, units) in BOXES.items():
        svg.rectangle(x - width / 2, top, x + width / 2, top + BOX, "tick" if runs & set(units) else "box", 5)
        svg.text(x, top + 17, title, "middle")
        svg.text(x, top + 32, about, "small middle")
    for number, name in enumerate(WAY, 1):
        x, y = (BOXES[name][0] - BOXES[name][2] / 2, BOXES[name][1]) if name in BOXES and name not in MODULES else \
            (MODULES[name][0], MODULES[name][1])
        svg.badge(x, y, number)
    heads = "".join(f'<marker id="{name}" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" '
                    f'markerUnits="userSpaceOnUse" orient="auto"><path d="M0 0.5 L8 4 L0 7.5 Z" class="{kind}"/></marker>'
                    for name, kind in (("use", "head"), ("call", "callhead")))
    body = "\n".join(svg.parts)
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}">\n'
            f"<!-- drawn by tests/architecture/check.py: do not edit -->\n<style>{STYLE}</style>\n<defs>{heads}</defs>\n"
            f"{body}\n</svg>\n"), missing
