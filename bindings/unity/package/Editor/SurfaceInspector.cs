using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>A surface's settings, and why it cannot be felt, or not as asked for.</summary>
    [CustomEditor(typeof(KnurlSurface)), CanEditMultipleObjects]
    internal sealed class SurfaceInspector : Editor
    {
        private const double SecondsBetweenLooks = 0.5; // a mesh may be large

        private static readonly GUIContent Grating = new GUIContent("Grating", "How the surface feels: a preset, or an " +
            "asset made by Create > Knurl > Grating");
        private static readonly GUIContent DoubleSided = new GUIContent("Double Sided", "Whether it can be touched from " +
            "behind as well");
        private static readonly GUIContent Axis = new GUIContent("Axis (mesh axes)", "The direction of the grating's x. " +
            "(0, 0, 0): the mesh's tangents, else its UVs");

        private string[] _warnings = new string[0];
        private double _lookAgain;

        public override void OnInspectorGUI()
        {
            serializedObject.Update();
            EditorGUI.BeginChangeCheck();
            EditorGUILayout.PropertyField(serializedObject.FindProperty("grating"), Grating);
            Presets.Draw(Take);
            EditorGUILayout.PropertyField(serializedObject.FindProperty("doubleSided"), DoubleSided);
            EditorGUILayout.PropertyField(serializedObject.FindProperty("axis"), Axis);
            if (EditorGUI.EndChangeCheck())
                _lookAgain = 0.0;
            serializedObject.ApplyModifiedProperties();
            if (!serializedObject.isEditingMultipleObjects)
                ShowState((KnurlSurface)target);
        }

        public override bool RequiresConstantRepaint()
        {
            return EditorApplication.isPlaying;
        }

        private void ShowState(KnurlSurface surface)
        {
            if (EditorApplication.timeSinceStartup >= _lookAgain)
            {
                _warnings = WarningsOf(surface);
                _lookAgain = EditorApplication.timeSinceStartup + SecondsBetweenLooks;
            }
            foreach (string warning in _warnings)
                EditorGUILayout.HelpBox(warning, MessageType.Warning);
            if (!EditorApplication.isPlaying)
                return;
            EditorGUILayout.LabelField("Triangles felt", Units.Number(surface.TriangleCount));
            EditorGUILayout.LabelField("Touched", surface.IsTouched ? "yes" : "no");
        }

        /// <summary>Never throws: an inspector that does draws nothing below.</summary>
        private static string[] WarningsOf(KnurlSurface surface)
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

        private void Take(KnurlGrating preset)
        {
            if (target == null)
                return; // it was deleted while the menu was open
            serializedObject.Update();
            serializedObject.FindProperty("grating").objectReferenceValue = preset;
            serializedObject.ApplyModifiedProperties();
            _lookAgain = 0.0;
        }
    }
}
