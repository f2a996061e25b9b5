// Unity's axes and Knurl's. SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl
{
    /// <summary>Unity is left-handed, Knurl's scene is glTF's, right-handed: x is mirrored, as in glTF importers for
    /// Unity, so that a file's surfaces coincide with its meshes. A matrix M becomes F M F with
    /// F = diag(-1, 1, 1).</summary>
    internal static unsafe class Axes
    {
        /// <summary>A position (m), a direction or a force (N).</summary>
        internal static void ToScene(Vector3 unity, double* scene)
        {
            scene[0] = -(double)unity.x;
            scene[1] = unity.y;
            scene[2] = unity.z;
        }

        /// <summary>Exact comparison; unlike Vector3.Equals(), also true for two NaN.</summary>
        internal static bool IsSame(Vector3 a, Vector3 b)
        {
            return a.x.Equals(b.x) && a.y.Equals(b.y) && a.z.Equals(b.z);
        }

        /// <summary>A position (m), a direction or a force (N).</summary>
        internal static Vector3 ToUnity(double* scene)
        {
            return new Vector3((float)(0.0 - scene[0]), (float)scene[1], (float)scene[2]); // no minus zero
        }

        /// <summary>A transform, as three rows of four for knurl_session_split_pose().</summary>
        internal static void ToScene(Matrix4x4* unity, double* rows)
        {
            rows[0] = unity->m00;
            rows[1] = -(double)unity->m01;
            rows[2] = -(double)unity->m02;
            rows[3] = -(double)unity->m03;
            rows[4] = -(double)unity->m10;
            rows[5] = unity->m11;
            rows[6] = unity->m12;
            rows[7] = unity->m13;
            rows[8] = -(double)unity->m20;
            rows[9] = unity->m21;
            rows[10] = unity->m22;
            rows[11] = unity->m23;
        }

        /// <summary>The workspace of a device with a position (m) and a rotation: its x to the
        /// right, its y up, its z towards the user, who looks along Unity's z. In scene axes that is F R D with
        /// D = diag(1, 1, -1): a proper rotation.</summary>
        internal static void ToWorkspace(Vector3 position, Quaternion rotation, double scale,
            knurl_workspace* workspace)
        {
            double x = rotation.x, y = rotation.y, z = rotation.z, w = rotation.w;
            double twice = 2.0 / (x * x + y * y + z * z + w * w); // a quaternion of floats is not exactly of length 1
            double* r = workspace->rotation;
            NativeMethods.knurl_workspace_set_identity(workspace);
            ToScene(position, workspace->origin);
            workspace->scale = scale;
            r[0] = -(1.0 - twice * (y * y + z * z));
            r[1] = -(twice * (x * y - z * w));
            r[2] = twice * (x * z + y * w);
            r[3] = twice * (x * y + z * w);
            r[4] = 1.0 - twice * (x * x + z * z);
            r[5] = -(twice * (y * z - x * w));
            r[6] = twice * (x * z - y * w);
            r[7] = twice * (y * z + x * w);
            r[8] = -(1.0 - twice * (x * x + y * y));
        }

        /// <summary>A stylus's rotation from its own axes, whose z is towards the user, as the rotation of an object
        /// that points along its z: M becomes F M D. F M F is the quaternion (x, -y, -z, w), F D half a turn about y.
        /// The identity
        /// for zeros.</summary>
        internal static Quaternion ToRotation(double* q)
        {
            return q[0] == 0.0 && q[1] == 0.0 && q[2] == 0.0 && q[3] == 0.0 ? Quaternion.identity
                : new Quaternion((float)q[2], (float)q[3], (float)q[0], (float)q[1]);
        }

        /// <summary>The direction in a mesh that an object's scale, shear and mirror map to a given direction in the
        /// object's own axes: converts <see cref="KnurlTag.Axis"/> to <see cref="KnurlSurface.Axis"/>. Zero if the
        /// object has no volume.</summary>
        internal static Vector3 ToMesh(Vector3 scaled, Matrix4x4 place)
        {
            knurl_session_pose pose;
            double* rows = stackalloc double[12];
            double* a = stackalloc double[3];
            ToScene(&place, rows);
            if (NativeMethods.knurl_session_split_pose(rows, &pose) == 0)
            {
                return Vector3.zero;
            }
            ToScene(scaled, a);
            double* rest = pose.rest; // upper triangular
            a[2] /= rest[8];
            a[1] = (a[1] - rest[5] * a[2]) / rest[4];
            a[0] = (a[0] - rest[1] * a[1] - rest[2] * a[2]) / rest[0];
            return ToUnity(a).normalized;
        }

        /// <summary>to = matrix (3 by 3, row-major) times from.</summary>
        internal static void Multiply(double* matrix, double* from, double* to)
        {
            for (int i = 0; i < 3; i++)
            {
                to[i] = matrix[3 * i] * from[0] + matrix[3 * i + 1] * from[1] + matrix[3 * i + 2] * from[2];
            }
        }

        internal static double Determinant(double* m)
        {
            return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6])
                + m[2] * (m[3] * m[7] - m[4] * m[6]);
        }
    }
}
