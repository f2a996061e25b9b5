// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl
{
    public partial class KnurlDevice
    {
        /// <summary>Finds the first hit of a line segment on the surfaces of this device. It tests their triangles in
        /// their current pose and does not use Unity's physics. A surface that is not double-sided is hit from its
        /// front only.</summary>
        /// <param name="from">Global.</param>
        /// <param name="to">Global.</param>
        /// <param name="hit">The first hit.</param>
        /// <returns>False if nothing is hit or the device does not run.</returns>
        public unsafe bool CastRay(Vector3 from, Vector3 to, out KnurlRayHit hit)
        {
            hit = default(KnurlRayHit);
            if (!isRunning)
            {
                return false;
            }
            double* ends = stackalloc double[6];
            Axes.ToScene(from, ends);
            Axes.ToScene(to, ends + 3);
            knurl_surface_point point;
            NativeMethods.knurl_surface_point_init(&point, (uint)sizeof(knurl_surface_point));
            knurl_scene* scene = NativeMethods.knurl_session_get_scene(session);
            Check("CastRay", NativeMethods.knurl_scene_cast_ray(scene, ends, ends + 3, &point));
            if (point.surface == 0)
            {
                return false;
            }
            hit.Position = Axes.ToUnity(point.position);
            hit.Normal = Axes.ToUnity(point.normal);
            hit.Distance = (float)point.distance;
            hit.Surface = following.Find(point.surface);
            return true;
        }
    }
}
