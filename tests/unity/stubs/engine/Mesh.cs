// Test-only stand-ins, never shipped.
using System;
using System.Collections.Generic;

namespace UnityEngine
{
    public enum MeshTopology
    {
        Triangles = 0,
        Quads = 2,
        Lines = 3,
        LineStrip = 4,
        Points = 5
    }

    namespace Rendering
    {
        public enum IndexFormat
        {
            UInt16,
            UInt32
        }

        public enum ShaderPropertyType
        {
            Color,
            Vector,
            Float,
            Range,
            Texture
        }

        public enum CompareFunction
        {
            Disabled,
            Never,
            Less,
            Equal,
            LessEqual,
            Greater,
            NotEqual,
            GreaterEqual,
            Always
        }
    }

    /// Faithful: arrays are copies, an unreadable mesh gives an error and is neither read nor written, submeshes and
    /// topologies, an error for a missing submesh, bounds that are updated by indices but not by vertices.
    /// Not: checks of index ranges and of lengths, base vertices (always 0), UV channels beyond 4, compression, GPU
    /// buffers, skins.
    public sealed class Mesh : Object
    {
        sealed class Part
        {
            internal int[] indices = new int[0];
            internal MeshTopology topology;
        }

        Vector3[] positions = new Vector3[0];
        Vector3[] normalArray = new Vector3[0];
        Vector4[] tangentArray = new Vector4[0];
        readonly Vector2[][] uvArrays = { new Vector2[0], new Vector2[0], new Vector2[0], new Vector2[0] };
        readonly List<Part> subMeshes = new List<Part> { new Part() };
        bool readable = true;

        Bounds box;

        public Bounds bounds
        {
            get { Living(); return box; }
            set { Living(); box = value; }
        }

        public Rendering.IndexFormat indexFormat { get; set; }
        public bool isReadable { get { Living(); return readable; } }
        public int vertexCount { get { Living(); return positions.Length; } }

        public int subMeshCount
        {
            get { Living(); return subMeshes.Count; }
            set
            {
                while (subMeshes.Count > value)
                {
                    subMeshes.RemoveAt(subMeshes.Count - 1);
                }
                while (subMeshes.Count < value)
                {
                    subMeshes.Add(new Part());
                }
            }
        }

        bool Allowed(string what)
        {
            Living();
            bool isAllowed = readable || (Application.isEditor && !Application.isPlaying); // MeshUtility's reference
            if (!isAllowed)
            {
                Debug.LogError("Not allowed to access " + what + " on mesh '" + held +
                               "' (isReadable is false; Read/Write must be enabled in import settings)", this);
            }
            return isAllowed;
        }

        T[] Copy<T>(T[] from, string what) { return Allowed(what) ? (T[])from.Clone() : new T[0]; }

        static void Check<T>(List<T> to)
        {
            if (to == null)
            {
                throw new ArgumentNullException("to");
            }
        }

        void Take<T>(ref T[] to, T[] from, string what)
        {
            if (Allowed(what))
            {
                to = from == null ? new T[0] : (T[])from.Clone();
            }
        }

        bool Has(int part) { return part >= 0 && part < subMeshes.Count; }

        bool Allowed(int part, string what)
        {
            bool allowed = Allowed("triangles/indices");
            if (allowed && !Has(part))
            {
                Debug.LogError("Failed getting " + what + ". Submesh index is out of bounds.", this);
            }
            return allowed && Has(part);
        }

        Part Find(int part)
        {
            Living();
            if (!Has(part))
            {
                throw new IndexOutOfRangeException("Specified sub mesh is out of range. " +
                    "Must be greater or equal to 0 and less than subMeshCount.");
            }
            return subMeshes[part];
        }

        static void Fill<T>(List<T> to, T[] from)
        {
            Check(to);
            to.Clear();
            if (to.Capacity < from.Length)
            {
                to.Capacity = from.Length;
            }
            for (int i = 0; i < from.Length; i++)
            {
                to.Add(from[i]);
            }
        }

        public Vector3[] vertices
        {
            get { return Copy(positions, "vertices"); }
            set { SetVertices(value); }
        }

        public Vector3[] normals
        {
            get { return Copy(normalArray, "normals"); }
            set { Take(ref normalArray, value, "normals"); }
        }

        public Vector4[] tangents
        {
            get { return Copy(tangentArray, "tangents"); }
            set { Take(ref tangentArray, value, "tangents"); }
        }

        public Vector2[] uv
        {
            get { return Copy(uvArrays[0], "uv"); }
            set { SetUVs(0, value); }
        }

        public int[] triangles
        {
            get
            {
                List<int> all = new List<int>();
                if (!Allowed("triangles/indices"))
                {
                    return new int[0];
                }
                for (int i = 0; i < subMeshes.Count; i++)
                {
                    all.AddRange(GetTriangles(i));
                }
                return all.ToArray();
            }
            set
            {
                if (Allowed("triangles/indices"))
                {
                    subMeshCount = 1;
                    SetTriangles(value, 0);
                }
            }
        }

        public void SetVertices(List<Vector3> value) { SetVertices(value.ToArray()); }

        public void SetVertices(Vector3[] value) { Take(ref positions, value, "vertices"); }

        public void SetUVs(int channel, List<Vector2> value) { SetUVs(channel, value.ToArray()); }
        public void SetUVs(int channel, Vector2[] value) { Take(ref uvArrays[channel], value, "uv"); }
        public void SetTriangles(int[] value, int part) { Set(value, MeshTopology.Triangles, part, "triangles"); }
        public void SetIndices(int[] value, MeshTopology topology, int part) { Set(value, topology, part, "indices"); }

        void Set(int[] value, MeshTopology topology, int part, string what)
        {
            if (Allowed(part, what))
            {
                Take(ref subMeshes[part].indices, value, "triangles/indices");
                subMeshes[part].topology = topology;
                RecalculateBounds();
            }
        }

        /// For tests: how often the vertices were read.
        public int Reads { get; private set; }

        public void GetVertices(List<Vector3> to)
        {
            Reads++;
            Fill(to, Allowed("vertices") ? positions : new Vector3[0]);
        }

        public void GetNormals(List<Vector3> to) { Fill(to, Allowed("normals") ? normalArray : new Vector3[0]); }
        public void GetTangents(List<Vector4> to) { Fill(to, Allowed("tangents") ? tangentArray : new Vector4[0]); }
        public void GetUVs(int i, List<Vector2> to) { Fill(to, Allowed("uv") ? uvArrays[i] : new Vector2[0]); }
        public int[] GetIndices(int part)
        {
            return Allowed(part, "indices") ? (int[])subMeshes[part].indices.Clone() : new int[0];
        }

        public MeshTopology GetTopology(int part)
        {
            Living();
            if (!Has(part))
            {
                Debug.LogError("Failed getting topology. Submesh index is out of bounds.", this);
                return MeshTopology.Triangles;
            }
            return subMeshes[part].topology;
        }

        public uint GetIndexCount(int part) { return (uint)Find(part).indices.Length; }
        public void UploadMeshData(bool markNoLongerReadable) { readable = readable && !markNoLongerReadable; }

        public int[] GetTriangles(int part)
        {
            if (!Allowed(part, "triangles"))
            {
                return new int[0];
            }
            Part p = subMeshes[part];
            if (p.topology == MeshTopology.Triangles)
            {
                return (int[])p.indices.Clone();
            }
            List<int> made = new List<int>();
            for (int i = 0; p.topology == MeshTopology.Quads && i + 3 < p.indices.Length; i += 4)
            {
                foreach (int corner in new[] { 0, 1, 2, 0, 2, 3 })
                {
                    made.Add(p.indices[i + corner]);
                }
            }
            return made.ToArray();
        }

        public void RecalculateBounds()
        {
            Bounds box = new Bounds(positions.Length > 0 ? positions[0] : Vector3.zero, Vector3.zero);
            foreach (Vector3 p in positions)
            {
                box.Encapsulate(p);
            }
            bounds = box;
        }

        public void Clear()
        {
            Living();
            positions = normalArray = new Vector3[0];
            tangentArray = new Vector4[0];
            for (int i = 0; i < uvArrays.Length; i++)
            {
                uvArrays[i] = new Vector2[0];
            }
            subMeshes.Clear();
            subMeshes.Add(new Part());
        }
    }

    /// Not: `mesh` copies in Unity; here it is the shared one.
    public sealed class MeshFilter : Component
    {
        Mesh shared;

        public Mesh sharedMesh
        {
            get { Living(); return shared; }
            set { Living(); shared = value; }
        }
    }
}

namespace UnityEngine.SceneManagement
{
    /// Set by a test.
    public struct Scene
    {
        public string Path;
        public GameObject[] Roots;
        public string path { get { return Path; } }
        public GameObject[] GetRootGameObjects() { return Roots; }
    }
}
