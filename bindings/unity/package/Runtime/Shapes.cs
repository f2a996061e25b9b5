// Shapes that several surfaces have. SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Runtime.CompilerServices;
using UnityEngine;

namespace Knurl
{
    /// <summary>The settings on which a surface's shape in the scene depends.</summary>
    internal unsafe struct ShapeKey : IEquatable<ShapeKey>
    {
        const int Words = 14;

        readonly Mesh mesh;
        fixed int words[Words]; // rest and axis, rounded, because equal scales differ in their last bits; settings

        internal ShapeKey(Mesh mesh, double* rest, KnurlSurface surface)
        {
            this.mesh = mesh;
            Vector3 axis = surface.Axis;
            fixed (int* to = words)
            {
                var numbers = (float*)to;
                for (int i = 0; i < 9; i++)
                {
                    numbers[i] = (float)rest[i] + 0f; // no -0
                }
                numbers[9] = axis.x + 0f;
                numbers[10] = axis.y + 0f;
                numbers[11] = axis.z + 0f;
                to[12] = (int)surface.Smooth;
                to[13] = surface.BoxCoordinates ? 1 : 0;
            }
        }

        internal bool IsOf(Mesh other)
        {
            return ReferenceEquals(mesh, other);
        }

        public bool Equals(ShapeKey other)
        {
            bool isSame = ReferenceEquals(mesh, other.mesh);
            fixed (int* mine = words)
            {
                for (int i = 0; i < Words; i++)
                {
                    isSame &= mine[i] == other.words[i];
                }
            }
            return isSame;
        }

        public override bool Equals(object other)
        {
            return other is ShapeKey && Equals((ShapeKey)other);
        }

        public override int GetHashCode()
        {
            int hash = RuntimeHelpers.GetHashCode(mesh);
            fixed (int* mine = words)
            {
                for (int i = 0; i < Words; i++)
                {
                    hash = unchecked(31 * hash + mine[i]);
                }
            }
            return hash;
        }
    }

    /// <summary>The shapes in a session's scene: copies of a mesh at one scale share one, which is read and whose
    /// tree is built once.</summary>
    internal sealed class Shapes
    {
        sealed class Shape
        {
            internal ShapeKey Key;
            internal readonly HashSet<ulong> Users = new HashSet<ulong>(); // ids of surfaces in the scene
        }

        readonly Dictionary<ShapeKey, Shape> byKey = new Dictionary<ShapeKey, Shape>();
        readonly Dictionary<ulong, Shape> byUser = new Dictionary<ulong, Shape>();

        /// <summary>The id of a surface in the scene that has the shape, or 0.</summary>
        internal ulong Find(ShapeKey key)
        {
            Shape shape;
            if (byKey.TryGetValue(key, out shape))
            {
                foreach (ulong user in shape.Users)
                {
                    return user;
                }
            }
            return 0;
        }

        /// <summary>A surface has got the shape of a key.</summary>
        internal void Join(ulong user, ShapeKey key)
        {
            Shape shape, had;
            bool isThere = byKey.TryGetValue(key, out shape);
            if (isThere && byUser.TryGetValue(user, out had) && ReferenceEquals(had, shape))
            {
                return;
            }
            if (!isThere)
            {
                shape = new Shape { Key = key };
                byKey.Add(key, shape);
            }
            shape.Users.Add(user);
            Leave(user);
            byUser.Add(user, shape);
        }

        /// <summary>A surface has left the scene, or has got another shape.</summary>
        internal void Leave(ulong user)
        {
            Shape shape, found;
            if (!byUser.TryGetValue(user, out shape))
            {
                return;
            }
            byUser.Remove(user);
            shape.Users.Remove(user);
            if (shape.Users.Count == 0 && byKey.TryGetValue(shape.Key, out found) && ReferenceEquals(found, shape))
            {
                byKey.Remove(shape.Key);
            }
        }

        /// <summary>The mesh has changed: surfaces that read it from now on get a new shape.</summary>
        internal void Forget(Mesh mesh)
        {
            var old = new List<ShapeKey>();
            foreach (ShapeKey key in byKey.Keys)
            {
                if (key.IsOf(mesh))
                {
                    old.Add(key);
                }
            }
            foreach (ShapeKey key in old)
            {
                byKey.Remove(key);
            }
        }
    }
}
