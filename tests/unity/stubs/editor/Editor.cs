// Test-only stand-ins, never shipped. Drawing is recorded in Drawn; fields return their argument, or a test's value in
// Answers under their label.
using System;
using System.Collections.Generic;
using System.Reflection;
using UnityEngine;

namespace UnityEditor
{
    [AttributeUsage(AttributeTargets.Class, AllowMultiple = true)]
    public sealed class CustomEditor : Attribute
    {
        public Type InspectedType { get; private set; }
        public CustomEditor(Type inspectedType) { InspectedType = inspectedType; }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class CanEditMultipleObjects : Attribute { }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class CustomPropertyDrawer : Attribute
    {
        public Type Type { get; private set; }
        public CustomPropertyDrawer(Type type) { Type = type; }
    }

    [AttributeUsage(AttributeTargets.Method, AllowMultiple = true)]
    public sealed class MenuItem : Attribute
    {
        public string menuItem { get; private set; }
        public bool validate { get; private set; }
        public int priority { get; private set; }
        public MenuItem(string itemName) : this(itemName, false, 1000) { }
        public MenuItem(string itemName, bool isValidateFunction) : this(itemName, isValidateFunction, 1000) { }
        public MenuItem(string itemName, bool isValidateFunction, int priority)
        {
            menuItem = itemName;
            validate = isValidateFunction;
            this.priority = priority;
        }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class InitializeOnLoadAttribute : Attribute { }

    [AttributeUsage(AttributeTargets.Method)]
    public sealed class InitializeOnLoadMethodAttribute : Attribute { }

    [Flags]
    public enum GizmoType
    {
        Pickable = 1,
        NotInSelectionHierarchy = 2,
        Selected = 4,
        Active = 8,
        InSelectionHierarchy = 16,
        NonSelected = 32
    }

    [AttributeUsage(AttributeTargets.Method)]
    public sealed class DrawGizmo : Attribute
    {
        public GizmoType drawOptions { get; private set; }
        public DrawGizmo(GizmoType gizmo) { drawOptions = gizmo; }
    }

    public sealed class MenuCommand
    {
        public UnityEngine.Object context;
        public MenuCommand(UnityEngine.Object context) { this.context = context; }
    }

    /// Made by CreateEditor(), which gives it its target and, as Unity does, sends OnEnable.
    public class Editor : ScriptableObject
    {
        UnityEngine.Object[] held = new UnityEngine.Object[0];
        SerializedObject serialized;

        public UnityEngine.Object target { get { return held.Length > 0 ? held[0] : null; } }
        public SerializedObject serializedObject
        {
            get { return serialized ?? (serialized = new SerializedObject(held)); }
        }

        public static Editor CreateEditor(UnityEngine.Object target, Type editorType)
        {
            return CreateEditor(new[] { target }, editorType);
        }

        public static Editor CreateEditor(UnityEngine.Object[] targets, Type editorType)
        {
            Editor made = (Editor)Activator.CreateInstance(editorType, true);
            made.held = targets;
            MethodInfo enable = editorType.GetMethod("OnEnable",
                BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic);
            if (enable != null)
            {
                enable.Invoke(made, null);
            }
            return made;
        }

        public virtual void OnInspectorGUI() { DrawDefaultInspector(); }
        public virtual bool RequiresConstantRepaint() { return false; }
        public virtual Texture2D RenderStaticPreview(string assetPath, UnityEngine.Object[] subAssets, int width,
            int height)
        {
            return null;
        }

        public bool DrawDefaultInspector()
        {
            EditorGUILayout.Drawn.Add("default inspector");
            return false;
        }
    }

    public class PropertyDrawer
    {
        public virtual void OnGUI(Rect position, SerializedProperty property, GUIContent label) { }
    }

    /// The last one shown; a test chooses from it.
    public sealed class GenericMenu
    {
        public delegate void MenuFunction();

        public static GenericMenu Shown;
        public readonly Dictionary<string, MenuFunction> Items = new Dictionary<string, MenuFunction>();
        public void AddItem(GUIContent content, bool on, MenuFunction func) { Items[content.text] = func; }
        public void ShowAsContext() { Shown = this; }
    }

    public enum MessageType
    {
        None,
        Info,
        Warning,
        Error
    }

    public static class EditorGUIUtility
    {
        public static void PingObject(UnityEngine.Object o) { }
    }

    /// Records drawing.
    public static class EditorGUILayout
    {
        public static readonly List<string> Drawn = new List<string>();
        public static readonly Dictionary<string, object> Answers = new Dictionary<string, object>();

        static T Field<T>(string label, T value)
        {
            Drawn.Add("field " + label + " = " + value);
            object answer;
            return Answers.TryGetValue(label, out answer) ? (T)answer : value;
        }

        public static void HelpBox(string message, MessageType type) { Drawn.Add(type + ": " + message); }
        public static void LabelField(string label, string value) { Drawn.Add("label " + label + ": " + value); }
        public static float FloatField(GUIContent label, float value) { return Field(label.text, value); }
        public static int MaskField(GUIContent label, int mask, string[] names) { return Field(label.text, mask); }
        public static bool Foldout(bool open, string label, bool toggles) { return Field(label, open); }

        public static bool PropertyField(SerializedProperty property, params GUILayoutOption[] options)
        {
            Drawn.Add("property " + property.name);
            return false;
        }

        public static bool PropertyField(SerializedProperty property, GUIContent label, params GUILayoutOption[] options)
        {
            Drawn.Add("property " + property.name + " as " + label.text);
            return false;
        }

        public static bool PropertyField(SerializedProperty property, bool children, params GUILayoutOption[] options)
        {
            return PropertyField(property, options);
        }

        public static bool DropdownButton(GUIContent content, FocusType focus, params GUILayoutOption[] options)
        {
            Drawn.Add("drop-down " + content.text);
            return Answers.ContainsKey(content.text);
        }
    }

    /// Changes and switches are not simulated.
    public static class EditorGUI
    {
        public static void BeginChangeCheck() { }
        public static bool EndChangeCheck() { return EditorGUILayout.Answers.Count > 0; }
        public static GUIContent BeginProperty(Rect rect, GUIContent label, SerializedProperty property) { return label; }
        public static void EndProperty() { }

        public static int MaskField(Rect rect, GUIContent label, int mask, string[] names)
        {
            return EditorGUILayout.MaskField(label, mask, names);
        }

        public static float FloatField(Rect rect, GUIContent label, float value)
        {
            return EditorGUILayout.FloatField(label, value);
        }
    }

    /// Records drawing, like Gizmos.
    public static class Handles
    {
        public static Color color { get; set; }
        public static Matrix4x4 matrix { get; set; }
        public static UnityEngine.Rendering.CompareFunction zTest { get; set; }
        static Handles() { color = Color.white; matrix = Matrix4x4.identity; zTest = UnityEngine.Rendering.CompareFunction.Always; }
        public static void DrawLines(Vector3[] segments) { EditorGUILayout.Drawn.Add("handle lines " + segments.Length / 2); }
        public static void Label(Vector3 at, string text) { EditorGUILayout.Drawn.Add("handle label " + text); }
    }
}
