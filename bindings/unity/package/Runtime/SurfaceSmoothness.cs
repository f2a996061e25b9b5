// SPDX-License-Identifier: MIT
namespace Knurl
{
    /// <summary>Whether a mesh is felt as a smooth surface or as its triangles. The numbers are those of Knurl's C
    /// interface.</summary>
    public enum SurfaceSmoothness
    {
        /// <summary>As it looks: smooth if the mesh has normals, with edges where they are split; otherwise as its
        /// triangles.</summary>
        Auto = 0,

        /// <summary>As its triangles: cheaper, and every facet is felt.</summary>
        Off = 1,

        /// <summary>Smooth. Normals are computed if the mesh has none; triangles more than 43 degrees apart keep their
        /// edge.</summary>
        On = 2
    }
}
