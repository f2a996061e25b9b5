// SPDX-License-Identifier: MIT
using System.Linq;
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Layers of devices, surfaces and effects, by name.</summary>
    [CustomPropertyDrawer(typeof(LayersAttribute))]
    internal sealed class LayersDrawer : PropertyDrawer
    {
        internal static readonly string[] Names = Enumerable.Range(1, 32).Select(i => "Layer " + i).ToArray();

        public override void OnGUI(Rect position, SerializedProperty property, GUIContent label)
        {
            label = EditorGUI.BeginProperty(position, label, property);
            EditorGUI.BeginChangeCheck();
            int layers = EditorGUI.MaskField(position, label, property.intValue, Names);
            if (EditorGUI.EndChangeCheck())
            {
                property.intValue = layers;
            }
            EditorGUI.EndProperty();
        }
    }

    /// <summary>Angles, stored in rad; unchanged unless they are edited.</summary>
    [CustomPropertyDrawer(typeof(DegreesAttribute))]
    internal sealed class DegreesDrawer : PropertyDrawer
    {
        public override void OnGUI(Rect position, SerializedProperty property, GUIContent label)
        {
            label = EditorGUI.BeginProperty(position, label, property);
            EditorGUI.BeginChangeCheck();
            float degrees = EditorGUI.FloatField(position, label, property.floatValue * Mathf.Rad2Deg);
            if (EditorGUI.EndChangeCheck())
            {
                property.floatValue = degrees * Mathf.Deg2Rad;
            }
            EditorGUI.EndProperty();
        }
    }
}
