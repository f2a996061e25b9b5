// Surfaces follow their objects into a device's scene. SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Knurl
{
    /// <summary>The state of each enabled surface in one session's scene. Main thread. A frame allocates nothing, and
    /// makes no native call for surfaces that do not move.</summary>
    internal sealed unsafe partial class Following
    {
        struct Follower
        {
            internal ulong id;       // in the scene; 0: not in the scene
            internal int made, felt; // of its surface, at the last change of its mesh or material
            internal int isFlat;     // 1: its scale is zero, so it is not in the scene
            internal int isOnLayer;  // 1: it has a layer in common with the device
            internal int isStale;    // 1: its shape has changed since its mesh was read
            internal float rereadAt; // s, unscaled: not before
            internal Matrix4x4 seen; // of its transform
            internal knurl_session_way way;
            internal fixed double rest[9]; // scale, shear and mirror baked into its mesh
        }

        readonly SessionHandle session;
        readonly knurl_scene* scene; // owned by the session
        readonly Shapes shapes = new Shapes();
        KnurlSurface[] surfaces = new KnurlSurface[16];
        Transform[] transforms = new Transform[16];
        Follower[] followers = new Follower[16];
        int count;
        long gratingsSeen;
        int layers; // of the device

        internal Following(SessionHandle session, int layers)
        {
            this.session = session;
            this.layers = layers;
            scene = NativeMethods.knurl_session_get_scene(session);
        }

        /// <summary>Adds all enabled surfaces, in the order of enabling. Errors go to the console.</summary>
        internal void Fill()
        {
            for (int i = 0; i < Registry.Surfaces.Count; i++)
            {
                Add(Registry.Surfaces[i]);
            }
            Follow(layers);
        }

        /// <summary>Adds a newly enabled surface at the next <see cref="Follow"/>, with its settings at that
        /// time.</summary>
        internal void Add(KnurlSurface surface)
        {
            if (count == surfaces.Length)
            {
                Array.Resize(ref surfaces, 2 * count);
                Array.Resize(ref transforms, 2 * count);
                Array.Resize(ref followers, 2 * count);
            }
            surfaces[count] = surface;
            transforms[count] = surface.transform;
            followers[count] = new Follower { made = surface.Made - 1 };
            count++;
        }

        /// <summary>Removes a surface that was disabled or destroyed.</summary>
        internal void Drop(KnurlSurface surface)
        {
            int i = IndexOf(surface);
            if (i < 0)
            {
                return;
            }
            fixed (Follower* f = &followers[i])
            {
                Remove(f);
            }
            count--;
            surfaces[i] = surfaces[count];
            transforms[i] = transforms[count];
            followers[i] = followers[count];
            surfaces[count] = null;
            transforms[count] = null;
        }

        /// <summary>Removes all surfaces from a scene that is kept because of surfaces from a file.</summary>
        internal void Clear()
        {
            while (count > 0)
            {
                Drop(surfaces[count - 1]);
            }
        }

        /// <summary>Call once per frame: adds new surfaces, moves those that moved, and updates changed
        /// materials.</summary>
        internal void Follow(int layersOfDevice)
        {
            layers = layersOfDevice;
            long changes = KnurlGrating.Changes;
            for (int i = 0; i < count; i++)
            {
                Matrix4x4 now = transforms[i].localToWorldMatrix;
                fixed (Follower* f = &followers[i])
                {
                    FollowOne(surfaces[i], f, &now, changes != gratingsSeen);
                }
            }
            gratingsSeen = changes;
        }

        /// <summary>The surface of an id, or null.</summary>
        internal KnurlSurface Find(ulong id)
        {
            for (int i = 0; i < count; i++)
            {
                if (followers[i].id == id)
                {
                    return surfaces[i];
                }
            }
            return null;
        }

        /// <summary>The triangles of a surface; 0 if it is not in the scene.</summary>
        internal int CountTriangles(KnurlSurface surface)
        {
            knurl_surface_info info;
            return Describe(surface, &info) ? (int)info.triangle_count : 0;
        }

        /// <summary>False if it is not in the scene.</summary>
        internal bool Describe(KnurlSurface surface, knurl_surface_info* info)
        {
            int i = IndexOf(surface);
            NativeMethods.knurl_surface_info_init(info, (uint)sizeof(knurl_surface_info));
            return i >= 0 && followers[i].id != 0
                && NativeMethods.knurl_scene_get_surface_info(scene, followers[i].id, info) == NativeMethods.KNURL_OK;
        }

        /// <summary>A mesh has changed.</summary>
        internal void Forget(Mesh mesh)
        {
            shapes.Forget(mesh);
        }

        /// <summary>Adds a warning for each setting of a surface that the device cannot render.</summary>
        internal void Explain(KnurlSurface surface, List<string> warnings)
        {
            const int size = 4096;
            int i = IndexOf(surface);
            if (i < 0 || followers[i].id == 0)
            {
                return;
            }
            byte* text = stackalloc byte[size];
            NativeMethods.knurl_session_explain(session, followers[i].id, text, size);
            string all = Utf8.Read(text);
            if (all != "")
            {
                warnings.AddRange(all.Split('\n'));
            }
        }

        int IndexOf(KnurlSurface surface)
        {
            for (int i = 0; i < count; i++)
            {
                if (ReferenceEquals(surfaces[i], surface))
                {
                    return i;
                }
            }
            return -1;
        }

        int IsOnLayer(KnurlSurface surface)
        {
            return (surface.Layers & layers) != 0 ? 1 : 0;
        }

        void FollowOne(KnurlSurface surface, Follower* f, Matrix4x4* now, bool gratingsChanged)
        {
            bool hasMoved = !IsSame(now, &f->seen);
            bool isFeltAnew = f->felt != surface.Felt || (gratingsChanged && surface.WasChangedSince(gratingsSeen));
            f->seen = *now;
            if (f->made != surface.Made || f->isOnLayer != IsOnLayer(surface) || (f->id == 0 && (f->isFlat != 0 ? hasMoved : isFeltAnew)))
            {
                Put(surface, f);
            }
            else if (f->id != 0)
            {
                if (isFeltAnew)
                {
                    Feel(surface, f);
                }
                if (hasMoved || f->isStale != 0)
                {
                    Move(surface, f);
                }
            }
        }

        /// <summary>Exact: Unity's == ignores small differences.</summary>
        static bool IsSame(Matrix4x4* a, Matrix4x4* b)
        {
            var x = (ulong*)a;
            var y = (ulong*)b;
            ulong difference = 0;
            for (int i = 0; i < sizeof(Matrix4x4) / sizeof(ulong); i++)
            {
                difference |= x[i] ^ y[i];
            }
            return difference == 0;
        }
    }
}
