// Changes of the scene by a follower. SPDX-License-Identifier: MIT
using System.Diagnostics;
using UnityEngine;
using Debug = UnityEngine.Debug;

namespace Knurl
{
    internal sealed unsafe partial class Following
    {
        static bool Split(Matrix4x4* matrix, knurl_session_pose* pose)
        {
            double* rows = stackalloc double[12];
            Axes.ToScene(matrix, rows);
            return NativeMethods.knurl_session_split_pose(rows, pose) != 0;
        }

        /// <summary>Adds the surface to the scene, or replaces it there without ending contact. Removes it if it cannot
        /// be felt.</summary>
        void Put(KnurlSurface surface, Follower* f)
        {
            knurl_session_pose pose;
            ulong before = f->id;
            f->made = surface.Made;
            f->felt = surface.Felt;
            f->isFlat = Split(&f->seen, &pose) ? 0 : 1;
            f->isOnLayer = IsOnLayer(surface);
            if (f->isFlat != 0 || f->isOnLayer == 0 || surface.Grating == null || !PutMesh(surface, f, &pose))
            {
                Remove(f);
                return;
            }
            if (before == 0)
            {
                f->way = default(knurl_session_way);
                f->way.clock = (uint)(IsMovedBySteps(surface) ? NativeMethods.KNURL_SESSION_STEPS
                    : NativeMethods.KNURL_SESSION_FRAMES);
                f->way.is_guess = 1; // scripts move bodies in frames, and other objects in steps
            }
            Copy(pose.position, f->way.position, 3);
            Copy(pose.rest, f->rest, 9);
        }

        /// <summary>Returns false after an error, which goes to the console.</summary>
        bool PutMesh(KnurlSurface surface, Follower* f, knurl_session_pose* pose)
        {
            Mesh mesh;
            string refusal = surface.FindMesh(out mesh);
            if (refusal != null)
            {
                Complain(surface, refusal);
                return false;
            }
            var key = new ShapeKey(mesh, pose->rest, surface);
            ulong shapeOf = shapes.Find(key);
            if (!PutShape(surface, shapeOf == 0 ? MeshReader.Read(mesh, pose->rest) : null, shapeOf, f, pose))
            {
                return false;
            }
            shapes.Join(f->id, key);
            return true;
        }

        /// <summary>A body without interpolation moves its objects in physics steps.</summary>
        internal static bool IsMovedBySteps(Component moved)
        {
            var body = moved.GetComponentInParent<Rigidbody>();
            return body != null && body.interpolation == RigidbodyInterpolation.None;
        }

        /// <summary>data: null if the surface gets the shape of another one, shapeOf.</summary>
        bool PutShape(KnurlSurface surface, MeshData data, ulong shapeOf, Follower* f, knurl_session_pose* pose)
        {
            knurl_material_desc material;
            knurl_surface_desc desc;
            surface.Grating.Describe(&material);
            NativeMethods.knurl_surface_desc_init(&desc, (uint)sizeof(knurl_surface_desc));
            desc.material = &material;
            desc.shape_of = shapeOf;
            desc.double_sided = surface.DoubleSided ? 1u : 0u;
            Copy(pose->position, desc.position, 3);
            Copy(pose->quaternion, desc.rotation, 4);
            return data != null ? PutMesh(surface, data, &desc, f, pose) : PutNamed(surface, &desc, f);
        }

        bool PutMesh(KnurlSurface surface, MeshData data, knurl_surface_desc* desc, Follower* f, knurl_session_pose* pose)
        {
            knurl_mesh_desc mesh;
            double* axis = stackalloc double[3];
            NativeMethods.knurl_mesh_desc_init(&mesh, (uint)sizeof(knurl_mesh_desc));
            mesh.vertex_count = (uint)(data.Positions.Length / 3);
            mesh.index_count = (ulong)data.Indices.Length;
            desc->mesh = &mesh;
            desc->smooth = (int)surface.Smooth;
            desc->coordinates = surface.BoxCoordinates ? NativeMethods.KNURL_COORDINATES_BOX : 0;
            Axes.ToScene(surface.Axis, axis);
            Axes.Multiply(pose->rest, axis, desc->axis); // the axis is in the mesh's axes: scaled like the mesh
            fixed (float* positions = data.Positions, normals = data.Normals, tangents = data.Tangents, uvs = data.Uvs)
            fixed (uint* indices = data.Indices)
            {
                mesh.positions = positions;
                mesh.normals = normals;
                mesh.tangents = tangents;
                mesh.uvs = uvs;
                mesh.indices = indices;
                return PutNamed(surface, desc, f);
            }
        }

        bool PutNamed(KnurlSurface surface, knurl_surface_desc* desc, Follower* f)
        {
            fixed (byte* name = Utf8.Bytes(surface.name.Replace('\0', ' '), "name"))
            {
                desc->name = name;
                return Tell(surface, f->id != 0 ? NativeMethods.knurl_scene_replace_surface(scene, f->id, desc)
                    : NativeMethods.knurl_scene_add_surface(scene, desc, &f->id));
            }
        }

        void Remove(Follower* f)
        {
            if (f->id != 0)
            {
                NativeMethods.knurl_scene_remove_surface(scene, f->id); // the session reports the end of a contact
                shapes.Leave(f->id);
                f->id = 0;
            }
        }

        void Feel(KnurlSurface surface, Follower* f)
        {
            knurl_material_desc material;
            f->felt = surface.Felt;
            if ((object)surface.Grating != null)
            {
                surface.Grating.Describe(&material);
                Tell(surface, NativeMethods.knurl_scene_set_material(scene, f->id, &material));
            }
        }

        void Move(KnurlSurface surface, Follower* f)
        {
            knurl_session_pose pose;
            if (!Split(&f->seen, &pose))
            {
                Remove(f);
                f->isFlat = 1;
                return;
            }
            f->isStale = NativeMethods.knurl_session_same_rest(pose.rest, f->rest) != 0 ? 0 : 1;
            if (f->isStale != 0 && Time.unscaledTime >= f->rereadAt)
            {
                Reread(surface, f);
            }
            else
            {
                Tell(surface, NativeMethods.knurl_session_move_surface(session, f->id, &f->way, pose.position,
                    pose.quaternion));
            }
        }

        /// <summary>After a change of scale or shear. An object that turns below an unevenly scaled one changes its shape in
        /// each frame: reading that takes at most a fiftieth of the time, and between two readings it only moves.</summary>
        void Reread(KnurlSurface surface, Follower* f)
        {
            const float share = 1f / 50f;
            Stopwatch watch = Stopwatch.StartNew();
            Put(surface, f);
            f->isStale = 0;
            f->rereadAt = Time.unscaledTime + (float)watch.Elapsed.TotalSeconds / share;
        }

        /// <summary>Finds the tangent plane, at its anchor, of the nearest surface that a ray hits. If it hits no
        /// surface, a known plane is kept, otherwise the first surface's is used. Returns false if there is no
        /// plane.</summary>
        internal bool FindPlane(Ray ray, ref Plane plane, bool isKnown)
        {
            knurl_surface_info info;
            float nearest = float.PositiveInfinity;
            NativeMethods.knurl_surface_info_init(&info, (uint)sizeof(knurl_surface_info));
            for (int i = 0; i < count; i++)
            {
                float distance;
                if (followers[i].id == 0 || NativeMethods.knurl_scene_get_surface_info(scene, followers[i].id, &info)
                    != NativeMethods.KNURL_OK)
                {
                    continue;
                }
                var own = new Plane(Axes.ToUnity(info.anchor_normal), Axes.ToUnity(info.anchor));
                bool isMet = own.Raycast(ray, out distance) && distance < nearest && IsInside(&info, ray.GetPoint(distance));
                if (isMet || !isKnown)
                {
                    plane = own;
                    isKnown = true;
                    nearest = isMet ? distance : nearest;
                }
            }
            return isKnown;
        }

        static bool IsInside(knurl_surface_info* info, Vector3 point)
        {
            const double margin = 0.001; // m: flat bounds have no thickness
            double* at = stackalloc double[3];
            Axes.ToScene(point, at);
            bool isInside = true;
            for (int i = 0; i < 3; i++)
            {
                isInside &= at[i] >= info->bounds_min[i] - margin && at[i] <= info->bounds_max[i] + margin;
            }
            return isInside;
        }

        /// <summary>Returns true on success; logs an error otherwise.</summary>
        static bool Tell(KnurlSurface surface, int result)
        {
            if (result != NativeMethods.KNURL_OK)
            {
                Complain(surface, Utf8.Read(NativeMethods.knurl_error_message()));
            }
            return result == NativeMethods.KNURL_OK;
        }

        static void Complain(KnurlSurface surface, string sentence)
        {
            Debug.LogError("KnurlSurface '" + surface.name + "': " + sentence, surface);
        }

        static void Copy(double* from, double* to, int length)
        {
            for (int i = 0; i < length; i++)
            {
                to[i] = from[i];
            }
        }
    }
}
