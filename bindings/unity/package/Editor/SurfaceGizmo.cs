// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using UnityEditor;
using UnityEngine;
using UnityEngine.Rendering;

namespace Knurl.Editing
{
    /// <summary>Draws the ridges of a selected surface at the places where they are felt.</summary>
    internal static class SurfaceGizmo
    {
        const int MostSegments = 8192;
        const int MostTriangles = 200000; // with more triangles, the editor would stutter while the surface is moved
        const float TowardsEye = 0.999f; // otherwise half of each line is hidden by the mesh
        static readonly Color Ink = new Color(1.0f, 0.62f, 0.2f, 0.8f);

        /// <summary>The last drawing, cached because it rarely changes.</summary>
        sealed class Drawing
        {
            internal Mesh Mesh;
            internal KnurlGrating Grating;
            internal long Version;
            internal int Made;
            internal Vector3 Scale; // of the layout
            internal readonly Stripes Stripes = new Stripes();
            internal Vector3[] Segments;
            internal int Every;
        }

        static readonly Dictionary<KnurlSurface, Drawing> Drawings = new Dictionary<KnurlSurface, Drawing>();

        static SurfaceGizmo()
        {
            Selection.selectionChanged += Drawings.Clear;
        }

        [DrawGizmo(GizmoType.Selected | GizmoType.InSelectionHierarchy)]
        static void Draw(KnurlSurface surface, GizmoType type)
        {
            Mesh mesh;
            if (surface.Grating == null || surface.FindMesh(out mesh) != null)
            {
                return; // its inspector says why
            }
            Drawing drawing = Update(surface, mesh);
            Matrix4x4 before = Handles.matrix;
            Handles.matrix = MoveTowards(Camera.current);
            Handles.zTest = CompareFunction.LessEqual;
            Handles.color = Ink;
            Handles.DrawLines(drawing.Segments);
            Handles.matrix = before;
            Handles.zTest = CompareFunction.Always;
            if (drawing.Segments.Length == 0 && drawing.Every == 0)
            {
                Handles.Label(surface.transform.position, "too many triangles to draw their ridges");
            }
            else if (drawing.Every > 1)
            {
                Handles.Label(surface.transform.position, "each line stands for " + drawing.Every + " ridges");
            }
        }

        static Matrix4x4 MoveTowards(Camera eye)
        {
            if (eye == null)
            {
                return Matrix4x4.identity;
            }
            Vector3 place = eye.transform.position;
            return Matrix4x4.TRS((1f - TowardsEye) * place, Quaternion.identity, TowardsEye * Vector3.one);
        }

        static Drawing Update(KnurlSurface surface, Mesh mesh)
        {
            Drawing drawing;
            if (!Drawings.TryGetValue(surface, out drawing))
            {
                drawing = new Drawing();
                Drawings.Add(surface, drawing);
            }
            KnurlGrating grating = surface.Grating;
            Stripes stripes = drawing.Stripes;
            Matrix4x4 place = surface.transform.localToWorldMatrix;
            bool isSame = drawing.Mesh == mesh && drawing.Grating == grating && drawing.Version == grating.Version
                && drawing.Made == surface.Made && stripes.ToWorld == place;
            if (!isSame)
            {
                Read(drawing, mesh);
                drawing.Grating = grating;
                drawing.Version = grating.Version;
                stripes.ToWorld = place;
                FindLayout(drawing, surface);
                drawing.Made = surface.Made;
                stripes.Axis = surface.Axis;
                stripes.SpatialFrequency = grating.SpatialFrequency;
                stripes.Orientation = grating.Orientation;
                Lay(drawing);
            }
            return drawing;
        }

        /// <summary>The library takes a while with large meshes: not for each move of the object.</summary>
        static void FindLayout(Drawing drawing, KnurlSurface surface)
        {
            Vector3 scale = surface.transform.lossyScale;
            SurfaceLayout known = drawing.Stripes.Layout;
            bool isSame = known != null && known.Coordinates != "" && drawing.Made == surface.Made && drawing.Scale == scale;
            if (!isSame && drawing.Stripes.Triangles.Length / 3 <= MostTriangles)
            {
                drawing.Stripes.Layout = new SurfaceLayout(surface);
                drawing.Scale = scale;
            }
        }

        static void Read(Drawing drawing, Mesh mesh)
        {
            if (drawing.Mesh != mesh)
            {
                drawing.Mesh = mesh;
                drawing.Stripes.Layout = null;
                drawing.Stripes.Read(mesh);
            }
        }

        /// <summary>Sets Every to 0 if there are too many triangles.</summary>
        static void Lay(Drawing drawing)
        {
            drawing.Segments = new Vector3[0];
            drawing.Every = 0;
            if (drawing.Stripes.Triangles.Length / 3 <= MostTriangles)
            {
                var segments = new Vector3[2 * MostSegments];
                int count = drawing.Stripes.Draw(segments, out drawing.Every);
                Array.Resize(ref segments, 2 * count);
                drawing.Segments = segments;
            }
        }
    }
}
