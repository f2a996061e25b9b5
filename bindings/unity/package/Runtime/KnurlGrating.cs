// SPDX-License-Identifier: MIT
using System;
using UnityEngine;

namespace Knurl
{
    /// <summary>How a surface feels: a grating of fine ridges on a wall with a stiffness. Surfaces may share one; a
    /// change is felt from the next frame on, on all of them. All values are per metre of the scene, so a workspace
    /// that is scaled up feels stiffer. Values are checked when a device uses them: a value out of range is an error in
    /// the console, and the surface feels as before. Main thread.</summary>
    [HelpURL(Manual.Grating)]
    [CreateAssetMenu(menuName = "Knurl/Grating", fileName = "Grating")]
    public sealed class KnurlGrating : ScriptableObject
    {
        [SerializeField, Tooltip("Ridges per metre along the surface's x and y. (0, 0) is a smooth surface. 1/m")]
        Vector2 spatialFrequency = new Vector2(1000f, 0f);

        [SerializeField, Min(0f), Tooltip("Half the height of the ridges from bottom to top. m")]
        float amplitude = 0.0002f;

        [SerializeField, Min(0f), Tooltip("Stiffness of the wall, above 0. What a device can do is said by the warnings "
            + "of its surfaces. N/m")]
        float stiffness = 400f;

        [SerializeField, Min(0f), Tooltip("Damping along the surface's normal. N s/m")]
        float damping;

        [SerializeField, Min(0f), Tooltip("Coefficient of dry friction across the surface.")]
        float friction;

        [SerializeField, Degrees, Tooltip("Turns the grating's x and y counter-clockwise about the normal. Degrees; in scripts rad")]
        float orientation;

        [SerializeField, Tooltip("How ridges are rendered. Default: as Bandlimited.")]
        GratingMethod method = GratingMethod.Default;

        [NonSerialized] long version; // restarts when scripts are reloaded, like Changes

        /// <summary>Number of changes of all gratings: if it is unchanged, so are they.</summary>
        internal static long Changes { get; private set; }

        /// <summary>The value of <see cref="Changes"/> at this one's last change; 0: never changed.</summary>
        internal long Version
        {
            get { return version; }
        }

        /// <summary>Ridges per metre along the surface's x and y (1/m), each 0 or above; (0, 0) is a smooth surface.
        /// Default (1000, 0).</summary>
        public Vector2 SpatialFrequency
        {
            get { return spatialFrequency; }
            set { spatialFrequency = value; Changed(); }
        }

        /// <summary>Half the height of the ridges from bottom to top (m), 0 or above. Default 0.0002.</summary>
        public float Amplitude
        {
            get { return amplitude; }
            set { amplitude = value; Changed(); }
        }

        /// <summary>Stiffness of the wall (N/m), above 0. Default 400. <see cref="KnurlSurface.GetWarnings"/> reports
        /// values that a device cannot render.</summary>
        public float Stiffness
        {
            get { return stiffness; }
            set { stiffness = value; Changed(); }
        }

        /// <summary>Damping along the surface's normal (N s/m), 0 or above. Default 0.</summary>
        public float Damping
        {
            get { return damping; }
            set { damping = value; Changed(); }
        }

        /// <summary>Coefficient of dry friction across the surface, 0 or above. Default 0.</summary>
        public float Friction
        {
            get { return friction; }
            set { friction = value; Changed(); }
        }

        /// <summary>Turns the grating's x and y counter-clockwise about the normal (rad), as seen from outside. Default
        /// 0.</summary>
        public float Orientation
        {
            get { return orientation; }
            set { orientation = value; Changed(); }
        }

        /// <summary>How ridges are rendered. Default <see cref="GratingMethod.Default"/>.</summary>
        public GratingMethod Method
        {
            get { return method; }
            set { method = value; Changed(); }
        }

        internal unsafe void Describe(knurl_material_desc* material)
        {
            NativeMethods.knurl_material_desc_init(material, (uint)sizeof(knurl_material_desc));
            material->method = (int)method;
            material->spatial_frequency[0] = spatialFrequency.x;
            material->spatial_frequency[1] = spatialFrequency.y;
            material->amplitude = amplitude;
            material->stiffness = stiffness;
            material->damping = damping;
            material->friction = friction;
            material->orientation = orientation;
        }

        void Changed()
        {
            version = ++Changes;
        }

        void OnValidate()
        {
            Changed();
        }
    }
}
