// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using UnityEngine;
using UnityEngine.Rendering;

namespace Knurl
{
    /// <summary>Draws the ridges of the <see cref="KnurlSurface"/> on this object over its mesh, at the places where they are
    /// felt: in the Game view and in built games, in the built-in pipeline, URP and HDRP. Draws nothing on a mesh of more
    /// than 200,000 triangles. Lays the ridges out again after each change of mesh, grating or scale, which takes some
    /// milliseconds for a large mesh; for a scale that goes on changing, in at most a fiftieth of the time. Main
    /// thread.</summary>
    [AddComponentMenu("Knurl/Knurl Stripes")]
    [HelpURL(Manual.Stripes)]
    [ExecuteAlways]
    [DisallowMultipleComponent]
    [RequireComponent(typeof(KnurlSurface))]
    public sealed class KnurlStripes : MonoBehaviour
    {
        const int MostTriangles = 200000;
        const double PausePerLay = 50.0; // of the time that it took

        [SerializeField, Tooltip("Colour over ridges; its alpha is how much of the mesh it covers.")]
        Color ridge = new Color(1f, 0.95f, 0.85f, 0.2f);

        [SerializeField, Tooltip("Colour over grooves.")]
        Color groove = new Color(0.03f, 0.04f, 0.08f, 0.65f);

        readonly Stripes stripes = new Stripes();
        KnurlSurface surface;
        Material material;
        Mesh overlay;
        Mesh seen; // and the rest: as of the overlay
        KnurlGrating seenGrating;
        long seenVersion;
        int seenMade;
        double[] seenRest;
        double layAgain; // s, as Time.realtimeSinceStartup

        /// <summary>Colour over ridges, with alpha.</summary>
        public Color Ridge
        {
            get { return ridge; }
            set { ridge = value; }
        }

        /// <summary>Colour over grooves, with alpha.</summary>
        public Color Groove
        {
            get { return groove; }
            set { groove = value; }
        }

        /// <summary>Each pipeline calls one of the two for every camera: the Scene view's too, whenever that is drawn. The
        /// built-in pipeline, which calls onPreCull, ends with Unity 7.</summary>
        void OnEnable()
        {
#if !UNITY_7000_0_OR_NEWER
            Camera.onPreCull += Draw;
#endif
            RenderPipelineManager.beginCameraRendering += Draw;
        }

        void OnDisable()
        {
#if !UNITY_7000_0_OR_NEWER
            Camera.onPreCull -= Draw;
#endif
            RenderPipelineManager.beginCameraRendering -= Draw;
        }

        void Draw(ScriptableRenderContext context, Camera eye)
        {
            Draw(eye);
        }

        void Draw(Camera eye)
        {
            Mesh mesh;
            surface = surface == null ? GetComponent<KnurlSurface>() : surface;
            if (surface.Grating == null || surface.Layers == 0 || surface.FindMesh(out mesh) != null || !FindMaterial())
            {
                return;
            }
            double now = Time.realtimeSinceStartupAsDouble;
            if (IsOther(mesh))
            {
                Lay(mesh);
            }
            else if (now >= layAgain && IsScaledAnew())
            {
                Lay(mesh);
                layAgain = now + (1.0 + PausePerLay) * (Time.realtimeSinceStartupAsDouble - now);
            }
            if (overlay.vertexCount == 0)
            {
                return;
            }
            material.SetColor("_Ridge", ridge);
            material.SetColor("_Groove", groove);
            var how = new RenderParams(material) { layer = gameObject.layer, camera = eye }; // without shadows
            Graphics.RenderMesh(how, overlay, 0, transform.localToWorldMatrix);
        }

        bool FindMaterial()
        {
            Shader shader = material == null ? Resources.Load<Shader>("KnurlStripes") : null;
            if (shader != null)
            {
                material = new Material(shader) { hideFlags = HideFlags.HideAndDontSave };
            }
            return material != null;
        }

        bool IsOther(Mesh mesh)
        {
            KnurlGrating grating = surface.Grating;
            return overlay == null || seen != mesh || seenGrating != grating || seenVersion != grating.Version
                || seenMade != surface.Made;
        }

        /// <summary>Also if it is sheared: as it turns below an unevenly scaled object.</summary>
        unsafe bool IsScaledAnew()
        {
            knurl_session_pose pose;
            double* rows = stackalloc double[12];
            Matrix4x4 place = transform.localToWorldMatrix;
            Axes.ToScene(&place, rows);
            fixed (double* rest = seenRest)
            {
                return Library.Check() == null && NativeMethods.knurl_session_split_pose(rows, &pose) != 0
                    && NativeMethods.knurl_session_same_rest(pose.rest, rest) == 0;
            }
        }

        void Lay(Mesh mesh)
        {
            KnurlGrating grating = surface.Grating;
            stripes.Layout = new SurfaceLayout(surface);
            stripes.Read(mesh);
            stripes.ToWorld = transform.localToWorldMatrix;
            stripes.Axis = surface.Axis;
            stripes.SpatialFrequency = grating.SpatialFrequency;
            stripes.Orientation = grating.Orientation;
            seen = mesh;
            seenGrating = grating;
            seenVersion = grating.Version;
            seenMade = surface.Made;
            seenRest = stripes.Layout.Rest;
            var places = new List<Vector3>();
            var cycles = new List<Vector2>();
            bool isFelt = stripes.Layout.Coordinates != ""; // not without the library, scaled to nothing or refused // not without the library, on no layer or scaled to nothing
            if (isFelt && stripes.Triangles.Length <= 3 * MostTriangles)
            {
                stripes.Fill(places, cycles);
            }
            var indices = new int[places.Count];
            for (int i = 0; i < indices.Length; i++)
            {
                indices[i] = i;
            }
            overlay = overlay == null ? new Mesh { name = "Knurl stripes", hideFlags = HideFlags.HideAndDontSave } : overlay;
            overlay.Clear();
            overlay.indexFormat = indices.Length > ushort.MaxValue ? IndexFormat.UInt32 : IndexFormat.UInt16;
            overlay.vertices = places.ToArray();
            overlay.uv = cycles.ToArray();
            overlay.SetIndices(indices, MeshTopology.Triangles, 0);
        }

        void OnDestroy()
        {
            DestroyImmediate(overlay);
            DestroyImmediate(material);
        }
    }
}
