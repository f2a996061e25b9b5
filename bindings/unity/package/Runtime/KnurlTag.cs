// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl
{
    /// <summary>A surface of a glTF file that is tagged as a grating: its name and its values. See <see
    /// cref="KnurlTags.Read(string)"/>.</summary>
    public sealed class KnurlTag
    {
        internal unsafe KnurlTag(knurl_surface_info* info, knurl_material_desc* material)
        {
            Name = Utf8.Read(info->name);
            SpatialFrequency = new Vector2((float)material->spatial_frequency[0],
                (float)material->spatial_frequency[1]);
            Amplitude = (float)material->amplitude;
            Stiffness = (float)material->stiffness;
            Damping = (float)material->damping;
            Friction = (float)material->friction;
            Orientation = (float)material->orientation;
            Method = (GratingMethod)material->method;
            DoubleSided = info->double_sided != 0;
            Axis = Axes.ToUnity(info->axis);
            Smooth = (SurfaceSmoothness)info->smooth;
            BoxCoordinates = Utf8.Read(info->coordinates) == "box";
        }

        /// <summary>The surface's name: its node's, or its mesh's if the node has no name.</summary>
        public string Name { get; }

        /// <summary>See <see cref="KnurlGrating.SpatialFrequency"/> (1/m).</summary>
        public Vector2 SpatialFrequency { get; }

        /// <summary>See <see cref="KnurlGrating.Amplitude"/> (m).</summary>
        public float Amplitude { get; }

        /// <summary>See <see cref="KnurlGrating.Stiffness"/> (N/m).</summary>
        public float Stiffness { get; }

        /// <summary>See <see cref="KnurlGrating.Damping"/> (N s/m).</summary>
        public float Damping { get; }

        /// <summary>See <see cref="KnurlGrating.Friction"/>.</summary>
        public float Friction { get; }

        /// <summary>See <see cref="KnurlGrating.Orientation"/> (rad).</summary>
        public float Orientation { get; }

        /// <summary>How ridges are rendered: never <see cref="GratingMethod.Default"/>.</summary>
        public GratingMethod Method { get; }

        /// <summary>True: the surface can be touched from behind as well.</summary>
        public bool DoubleSided { get; }

        /// <summary>The grating's x if the tag has an axis: of length 1, in the axes of the object that shows the
        /// surface, after its scale. Otherwise zero.</summary>
        public Vector3 Axis { get; }

        /// <summary>True: ridges follow positions, by the tag or because the mesh has neither UVs nor
        /// tangents.</summary>
        public bool BoxCoordinates { get; }

        /// <summary>See <see cref="KnurlSurface.Smooth"/>.</summary>
        public SurfaceSmoothness Smooth { get; }

        /// <summary>The names in its file; null if it was not read from a whole one.</summary>
        internal GltfNames Names { get; set; }

        /// <summary>A new grating with its values.</summary>
        internal KnurlGrating MakeGrating(string name)
        {
            var grating = ScriptableObject.CreateInstance<KnurlGrating>();
            grating.name = name;
            CopyTo(grating);
            return grating;
        }

        /// <summary>Its axis in the axes of the mesh; zero if it has none. place: the object's matrix in the file.</summary>
        internal Vector3 AxisIn(Matrix4x4 place)
        {
            return Axis == Vector3.zero ? Axis : Axes.ToMesh(Axis, place);
        }

        /// <summary>Makes a surface feel as the tag says. axis: the tag's, in the mesh's axes; zero: the surface keeps
        /// its own.</summary>
        internal void CopyTo(KnurlSurface surface, KnurlGrating grating, Vector3 axis)
        {
            surface.Grating = grating;
            surface.DoubleSided = DoubleSided;
            surface.Smooth = Smooth;
            if (axis != Vector3.zero)
            {
                surface.Axis = axis;
            }
            surface.BoxCoordinates = BoxCoordinates && surface.Axis == Vector3.zero;
        }

        /// <summary>Copies all values to a grating.</summary>
        public void CopyTo(KnurlGrating grating)
        {
            grating.SpatialFrequency = SpatialFrequency;
            grating.Amplitude = Amplitude;
            grating.Stiffness = Stiffness;
            grating.Damping = Damping;
            grating.Friction = Friction;
            grating.Orientation = Orientation;
            grating.Method = Method;
        }
    }
}
