// SPDX-License-Identifier: MIT
using System;
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Common base of the inspectors of a device and a surface.</summary>
    internal abstract class KnurlInspector : Editor
    {
        bool showEvents;

        public override bool RequiresConstantRepaint()
        {
            return EditorApplication.isPlaying;
        }

        protected void Draw(string field, GUIContent label)
        {
            EditorGUILayout.PropertyField(serializedObject.FindProperty(field), label);
        }

        /// <summary>Draws event fields in a foldout.</summary>
        protected void DrawEvents(string[] fields)
        {
            showEvents = EditorGUILayout.Foldout(showEvents, "Events", true);
            for (int i = 0; showEvents && i < fields.Length; i++)
            {
                EditorGUILayout.PropertyField(serializedObject.FindProperty(fields[i]), true);
            }
        }

        protected static void DrawWarnings(string[] warnings)
        {
            foreach (string warning in warnings)
            {
                EditorGUILayout.HelpBox(warning, MessageType.Warning);
            }
        }

        /// <summary>Changes a field, as one undo step.</summary>
        protected void Change(string field, Action<SerializedProperty> change)
        {
            if (target == null)
            {
                return; // it was deleted while a menu was open
            }
            serializedObject.Update();
            change(serializedObject.FindProperty(field));
            serializedObject.ApplyModifiedProperties();
        }
    }
}
