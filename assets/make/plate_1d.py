# Builds assets/plate_1d.glb in Blender: three bars to stroke, of 1, 0.5 and 2 mm period, on a stand without a tag.
#   blender --background --factory-startup --python plate_1d.py -- OUT.glb
# Blender is z up: its (x, y, z) becomes glTF's (x, z, -y).
# SPDX-License-Identifier: MIT
import sys

import bmesh
import bpy

LENGTH, DEPTH = 0.120, 0.018  # m, of a bar along x and across it
PITCH = 0.022                 # m, from bar to bar
AMPLITUDE, STIFFNESS = 0.0002, 400.0

# name, cycles/m, place across (glTF z, in pitches), colour of ridges, colour of grooves (sRGB). Strokes follow the
# first.
BARS = (
    ("bar 1 mm", 1000.0, 0, (0.96, 0.78, 0.42), (0.62, 0.42, 0.13)),
    ("bar 0.5 mm", 2000.0, -1, (0.93, 0.62, 0.50), (0.58, 0.27, 0.17)),
    ("bar 2 mm", 500.0, 1, (0.80, 0.86, 0.90), (0.38, 0.47, 0.55)),
)


def stripe_image(name, ridge, groove):
    """One period of a grating, with the middle of a ridge at u = 0, so that the picture matches the ridges as felt."""
    width, height = 16, 4
    image = bpy.data.images.new(name, width, height)
    row = [*ridge, 1.0] * 4 + [*groove, 1.0] * 8 + [*ridge, 1.0] * 4
    image.pixels.foreach_set(row * height)
    image.pack()
    return image


def material(name, roughness, metallic, colour=(1.0, 1.0, 1.0), image=None):
    result = bpy.data.materials.new(name)
    result.use_nodes = True
    result.use_backface_culling = True  # otherwise it is doubleSided in glTF, and felt from below as well
    nodes = result.node_tree.nodes
    shader = nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = roughness
    shader.inputs["Metallic"].default_value = metallic
    if image:
        texture = nodes.new("ShaderNodeTexImage")
        texture.image = image
        result.node_tree.links.new(texture.outputs["Color"], shader.inputs["Base Color"])
    return result


def add_object(name, mesh, surface_material, place=(0.0, 0.0, 0.0)):
    geometry = bpy.data.meshes.new(name)
    mesh.to_mesh(geometry)
    mesh.free()
    geometry.materials.append(surface_material)
    thing = bpy.data.objects.new(name, geometry)
    thing.location = place
    bpy.context.scene.collection.objects.link(thing)


def add_bar(name, spatial_frequency, slot, ridge, groove):
    """A flat bar that faces up. One unit of u is one period, along +x; v has the same scale: no stretch."""
    tagged = material(name, 0.35, 0.6, image=stripe_image(f"stripes {spatial_frequency:.0f} per m", ridge, groove))
    tagged["knurl_spatial_frequency"] = spatial_frequency  # cycles/m
    tagged["knurl_amplitude"] = AMPLITUDE                  # m, half peak to peak
    tagged["knurl_stiffness"] = STIFFNESS                  # N/m
    mesh = bmesh.new()
    uv = mesh.loops.layers.uv.new("UVMap")
    x, y = LENGTH / 2, DEPTH / 2
    face = mesh.faces.new([mesh.verts.new(corner) for corner in ((-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0))])
    for loop in face.loops:
        loop[uv].uv = (loop.vert.co.x * spatial_frequency, loop.vert.co.y * spatial_frequency)
    add_object(name, mesh, tagged, (0.0, -slot * PITCH, 0.0))


def add_box(mesh, size, top, centre_y=0.0, bevel=0.0):
    """A box of `size` with its top face at z = top; all its edges are rounded if bevel > 0."""
    made = bmesh.ops.create_cube(mesh, size=1.0)["verts"]
    bmesh.ops.scale(mesh, vec=size, verts=made)
    bmesh.ops.translate(mesh, vec=(0.0, centre_y, top - size[2] / 2), verts=made)
    if bevel:
        edges = list({edge for vert in made for edge in vert.link_edges})
        bmesh.ops.bevel(mesh, geom=edges, offset=bevel, segments=4, profile=0.5, affect="EDGES", clamp_overlap=True)


def add_bodies():
    """The stand of a bar: its four sides with a narrow chamfer, open at the top under the bar."""
    mesh = bmesh.new()
    chamfer, foot = 0.0006, -0.0045
    for _, _, slot, _, _ in BARS:
        rings = []
        for grow, z in ((0.0, 0.0), (chamfer, -chamfer), (chamfer, foot)):
            x, y, middle = LENGTH / 2 + grow, DEPTH / 2 + grow, -slot * PITCH
            corners = ((-x, middle - y, z), (x, middle - y, z), (x, middle + y, z), (-x, middle + y, z))
            rings.append([mesh.verts.new(corner) for corner in corners])
        for upper, lower in zip(rings, rings[1:]):
            for i in range(4):
                j = (i + 1) % 4
                mesh.faces.new((lower[i], lower[j], upper[j], upper[i]))
    add_object("bar sides", mesh, material("steel", 0.30, 0.9, (0.42, 0.44, 0.47)))


def add_stand():
    mesh = bmesh.new()
    add_box(mesh, (0.140, 0.082, 0.010), top=-0.004, bevel=0.0025)
    for face in mesh.faces:
        face.smooth = face.calc_area() < 2e-4
    add_object("stand", mesh, material("slate", 0.65, 0.0, (0.022, 0.030, 0.042)))


def main():
    out = sys.argv[sys.argv.index("--") + 1]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for bar in BARS:
        add_bar(*bar)
    add_bodies()
    add_stand()
    bpy.ops.export_scene.gltf(filepath=out, export_format="GLB", export_extras=True, export_yup=True,
                              export_animations=False, export_copyright="Knurl contributors, MIT licence")


main()
