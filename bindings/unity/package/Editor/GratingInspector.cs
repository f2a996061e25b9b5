// SPDX-License-Identifier: MIT
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Shows a grating's values with their units, their effect, and presets to start from.</summary>
    [CustomEditor(typeof(KnurlGrating)), CanEditMultipleObjects]
    internal sealed class GratingInspector : Editor
    {
        internal static readonly string[] Fields =
        {
            "spatialFrequency", "amplitude", "stiffness", "damping", "friction", "orientation", "method",
        };

        static readonly GUIContent[] Labels =
        {
            new GUIContent("Spatial Frequency (1/m)", "Ridges per metre along the surface's x and y; 1000 is one a " +
                "millimetre. (0, 0) is a smooth surface"),
            new GUIContent("Amplitude (m)", "Half the height of the ridges from bottom to top: 0.0002 is 0.2 mm"),
            new GUIContent("Stiffness (N/m)", "Of the wall. What a device can do is said at the surface"),
            new GUIContent("Damping (N s/m)", "Along the surface's normal"),
            new GUIContent("Friction (coefficient)", "Dry friction across the surface"),
            new GUIContent("Orientation (degrees)", "Turns the grating's x and y counter-clockwise about the normal, " +
                "seen from outside"),
            new GUIContent("Method", "S1 looks the height up at the position; S2 plays balanced events at the " +
                "frequency that the velocity asks for; Bandlimited, the default, plays of the ridges' harmonics those " +
                "that the update rate can carry, in step with the surface"),
        };

        public override void OnInspectorGUI()
        {
            serializedObject.Update();
            for (int i = 0; i < Fields.Length; i++)
            {
                EditorGUILayout.PropertyField(serializedObject.FindProperty(Fields[i]), Labels[i]);
            }
            Presets.Draw(Take);
            serializedObject.ApplyModifiedProperties();
            if (!serializedObject.isEditingMultipleObjects)
            {
                var grating = (KnurlGrating)target;
                string wrong = FindWrong(grating);
                MessageType type = wrong == null ? MessageType.Info : MessageType.Error;
                EditorGUILayout.HelpBox(wrong ?? Explain(grating), type);
            }
        }

        /// <summary>The thumbnail for the Project window, of presets too.</summary>
        public override Texture2D RenderStaticPreview(string assetPath, Object[] subAssets, int width, int height)
        {
            var picture = new Texture2D(width, height, TextureFormat.RGBA32, false);
            picture.SetPixels32(Thumbnail.Draw((KnurlGrating)target, width, height));
            picture.Apply();
            return picture;
        }

        void Take(KnurlGrating preset)
        {
            if (target == null)
            {
                return; // it was deleted while the menu was open
            }
            Copy(new SerializedObject(preset), serializedObject);
        }

        /// <summary>Copies all values of one grating into another, as one undo step.</summary>
        internal static void Copy(SerializedObject from, SerializedObject to)
        {
            to.Update();
            foreach (string field in Fields)
            {
                to.CopyFromSerializedProperty(from.FindProperty(field));
            }
            to.ApplyModifiedProperties();
        }

        /// <summary>Why it cannot be felt; null if it can.</summary>
        static string FindWrong(KnurlGrating grating)
        {
            Vector2 frequency = grating.SpatialFrequency;
            return !(grating.Stiffness > 0f) ? "Stiffness: expected more than 0. It cannot be felt."
                : !(frequency.x >= 0f && frequency.y >= 0f)
                ? "Spatial Frequency: expected 0 or more. It cannot be felt."
                : !(grating.Amplitude >= 0f && grating.Damping >= 0f && grating.Friction >= 0f)
                ? "Amplitude, Damping, Friction: expected 0 or more. It cannot be felt."
                : null;
        }

        static string Explain(KnurlGrating grating)
        {
            string turned = grating.Orientation != 0.0f
                ? " Turned by " + Units.Number(grating.Orientation * Mathf.Rad2Deg) + " degrees."
                : "";
            return Units.Describe(grating.SpatialFrequency, grating.Amplitude) + turned;
        }
    }
}
