// SPDX-License-Identifier: MIT
using System;
using UnityEditor;
using UnityEditor.SceneManagement;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Shows a surface's settings and warnings.</summary>
    [CustomEditor(typeof(KnurlSurface)), CanEditMultipleObjects]
    internal sealed class SurfaceInspector : KnurlInspector
    {
        const double SecondsBetweenLooks = 0.5; // a mesh may be large

        static readonly GUIContent Grating = new GUIContent("Grating", "How the surface feels: an asset, made by " +
            "one of the buttons below, or by Create > Knurl > Grating");
        static readonly GUIContent DoubleSided = new GUIContent("Double Sided", "Whether it can be touched from " +
            "behind as well");
        static readonly GUIContent Axis = new GUIContent("Axis (mesh axes)", "The direction of the grating's x. " +
            "(0, 0, 0): the mesh's UVs, else its tangents, else box coordinates");
        static readonly GUIContent Box = new GUIContent("Box Coordinates", "Whether ridges are laid out by positions " +
            "in the mesh's axes, instead of by UVs");
        static readonly GUIContent Smooth = new GUIContent("Smooth", "Auto: as smooth as it looks, by the mesh's normals. " +
            "Off: as its triangles. On: smooth, with computed normals if the mesh has none");

        static readonly GUIContent Reaction = new GUIContent("Reaction", "Whether the nearest Rigidbody at or above it is " +
            "pushed by the opposite of what the hand feels");

        static readonly GUIContent Layers = new GUIContent("Layers", "Only devices feel it that have one of these layers too");

        static readonly string[] Events = { "touched", "released", "ridgesPassed" };

        string[] warnings = new string[0];
        double lookAgain;

        public override void OnInspectorGUI()
        {
            serializedObject.Update();
            EditorGUI.BeginChangeCheck();
            Draw("grating", Grating);
            DrawGratings();
            Draw("doubleSided", DoubleSided);
            Draw("axis", Axis);
            Draw("boxCoordinates", Box);
            Draw("smooth", Smooth);
            Draw("reaction", Reaction);
            Draw("layers", Layers);
            if (EditorGUI.EndChangeCheck())
            {
                lookAgain = 0.0;
            }
            DrawEvents(Events);
            serializedObject.ApplyModifiedProperties();
            if (!serializedObject.isEditingMultipleObjects)
            {
                ShowState((KnurlSurface)target);
            }
        }

        /// <summary>The chosen grating can be edited: a preset is copied into the project first.</summary>
        void DrawGratings()
        {
            Presets.Draw(preset => Take(Presets.Copy(preset)));
            if (GUILayout.Button("New grating"))
            {
                Take(Presets.New());
            }
            var given = serializedObject.FindProperty("grating").objectReferenceValue as KnurlGrating;
            if (!Presets.IsPreset(given))
            {
                return;
            }
            EditorGUILayout.HelpBox("This grating is the package's own, not to be edited.", MessageType.Info);
            if (GUILayout.Button("Make a copy to edit"))
            {
                Take(Presets.Copy(given));
            }
        }

        void ShowState(KnurlSurface surface)
        {
            bool laysOut = Event.current.type == EventType.Layout; // only draw the controls that were laid out
            if (laysOut && EditorApplication.timeSinceStartup >= lookAgain)
            {
                warnings = WarningsOf(surface);
                lookAgain = EditorApplication.timeSinceStartup + SecondsBetweenLooks;
            }
            DrawWarnings(warnings);
            DrawMakeReadable(surface.GetComponent<MeshFilter>());
            DrawStore(surface);
            if (!EditorApplication.isPlaying)
            {
                return;
            }
            EditorGUILayout.LabelField("Triangles felt", Units.Number(surface.TriangleCount));
            EditorGUILayout.LabelField("Touched", surface.IsTouched ? "yes" : "no");
        }

        void DrawMakeReadable(MeshFilter filter)
        {
            if (warnings.Length > 0 && filter != null && Readable.CanMake(filter.sharedMesh)
                && GUILayout.Button("Make readable"))
            {
                Readable.Make(filter.sharedMesh);
                lookAgain = 0.0;
            }
        }

        /// <summary>For prefabs: a scene's surfaces are stored when it is built.</summary>
        void DrawStore(KnurlSurface surface)
        {
            bool isStored = surface.Geometry != null, isPrefabs = EditorUtility.IsPersistent(surface)
                || PrefabStageUtility.GetPrefabStage(surface.gameObject) != null;
            string fault = isPrefabs ? BuildCheck.FaultOf(surface, true) : null;
            if ((fault != null || isStored) && GUILayout.Button(isStored ? "Store geometry again" : "Store geometry"))
            {
                Store(surface.GetComponent<MeshFilter>().sharedMesh, surface.Geometry);
            }
        }

        /// <summary>Into the asset that is there, if it is of the same mesh.</summary>
        void Store(Mesh mesh, KnurlGeometry before)
        {
            bool isSame = before != null && mesh != null && EditorUtility.IsPersistent(before)
                && before.name.StartsWith(NameOf(mesh), StringComparison.Ordinal);
            if (isSame && before.Take(mesh))
            {
                EditorUtility.SetDirty(before);
                AssetDatabase.SaveAssetIfDirty(before);
                lookAgain = 0.0;
                return;
            }
            KnurlGeometry made = KnurlGeometry.Of(mesh);
            if (made != null)
            {
                Change("geometry", property => property.objectReferenceValue = Presets.Save(made, NameOf(mesh)));
            }
        }

        static string NameOf(Mesh mesh)
        {
            return mesh.name + " geometry";
        }

        /// <summary>Never throws: after an exception, an inspector draws nothing more.</summary>
        static string[] WarningsOf(KnurlSurface surface)
        {
            try
            {
                return surface.GetWarnings();
            }
            catch (KnurlException exception)
            {
                return new[] { exception.Message };
            }
        }

        void Take(KnurlGrating given)
        {
            Change("grating", property => property.objectReferenceValue = given);
            lookAgain = 0.0;
        }
    }
}
