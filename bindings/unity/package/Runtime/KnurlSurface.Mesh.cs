// The mesh that is felt: the MeshFilter's, or stored triangles. SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl
{
    public sealed partial class KnurlSurface
    {
        [SerializeField, HideInInspector, Tooltip("Stored triangles, for meshes that a player cannot read.")]
        KnurlGeometry geometry;

        /// <summary>Stored triangles, which are felt in place of a mesh that cannot be read, and in a built game always. Null,
        /// the default: the mesh itself. A scene's surfaces get theirs when it is built. In a game, <see cref="UpdateMesh"/> sets
        /// it to null if the mesh can be read.</summary>
        public KnurlGeometry Geometry
        {
            get { return geometry; }
            set { geometry = value; Made++; }
        }

        /// <summary>Number of triangles that are felt; 0 if no running device feels it.</summary>
        public int TriangleCount
        {
            get
            {
                int count = 0;
                for (int i = 0; i < Registry.Devices.Count && count == 0; i++)
                {
                    count = Registry.Devices[i].CountTriangles(this);
                }
                return count;
            }
        }

        /// <summary>Reads the mesh again in the next frame. Call it after a change of the mesh or of the MeshFilter's
        /// mesh, for each surface that shows it. A finger that rests on it stays in contact.</summary>
        public void UpdateMesh()
        {
            Mesh mesh;
            if (FindOwnMesh(out mesh) == null && Application.isPlaying)
            {
                geometry = null; // of the mesh before the change
            }
            FindMesh(out mesh);
            for (int i = 0; mesh != null && i < Registry.Devices.Count; i++)
            {
                Registry.Devices[i].Forget(mesh);
            }
            Made++;
        }

        /// <summary>Metres along the surface for each unit of u and v, at the object's scale, as ridges are laid out: the mean by
        /// area, without triangles whose UVs are much larger or smaller than most. (0, 0) if the ridges do not follow UVs, or it
        /// cannot be felt. Reads the mesh at each call.</summary>
        public Vector2 GetUvScale()
        {
            Mesh mesh;
            if (grating == null || FindMesh(out mesh) != null)
            {
                return Vector2.zero;
            }
            var layout = new SurfaceLayout(this);
            return new Vector2((float)layout.UScale, (float)layout.VScale);
        }

        /// <summary>Finds the mesh that is felt, or null. Returns why it cannot be felt, or null if it can.</summary>
        internal string FindMesh(out Mesh mesh)
        {
            string refusal = FindOwnMesh(out mesh);
            if (geometry != null && (refusal != null || !Application.isEditor))
            {
                mesh = geometry.Mesh;
                return null;
            }
            mesh = refusal == null ? mesh : null;
            return refusal;
        }

        /// <summary>Finds the MeshFilter's mesh, which may be null. Returns why it cannot be felt, or null if it can.</summary>
        string FindOwnMesh(out Mesh mesh)
        {
            var filter = GetComponent<MeshFilter>();
            var drawn = GetComponent<Renderer>();
            mesh = filter == null ? null : filter.sharedMesh;
            return mesh == null ? "Its MeshFilter has no mesh: there is nothing to feel."
                : drawn != null && drawn.isPartOfStaticBatch
                ? "Its mesh was merged with others into '" + mesh.name + "' by static batching: clear Batching Static "
                    + "among the static flags of its GameObject."
                : MeshReader.Refusal(mesh);
        }
    }
}
