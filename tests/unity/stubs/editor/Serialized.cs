// Test-only stand-ins, never shipped.
using System;
using System.Reflection;
using UnityEngine;

namespace UnityEditor
{
    /// Fields by reflection, public or with SerializeField, written through at once to all targets. Not: arrays, nested
    /// paths, undo.
    public sealed class SerializedObject : IDisposable
    {
        public UnityEngine.Object[] targetObjects { get; private set; }
        public UnityEngine.Object targetObject { get { return targetObjects[0]; } }
        public bool isEditingMultipleObjects { get { return targetObjects.Length > 1; } }

        public SerializedObject(UnityEngine.Object target) { targetObjects = new[] { target }; }
        public SerializedObject(UnityEngine.Object[] targets) { targetObjects = targets; }
        public void Update() { }
        public void UpdateIfRequiredOrScript() { }
        public bool ApplyModifiedPropertiesWithoutUndo() { return ApplyModifiedProperties(); }
        public void Dispose() { }

        /// As in Unity, the targets' OnValidate runs.
        public bool ApplyModifiedProperties()
        {
            foreach (UnityEngine.Object target in targetObjects)
            {
                MethodInfo validate = target.GetType().GetMethod("OnValidate",
                    BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic);
                if (validate != null)
                {
                    validate.Invoke(target, null);
                }
            }
            return true;
        }

        public void CopyFromSerializedProperty(SerializedProperty property)
        {
            FindProperty(property.name).CopyFrom(property);
        }

        public SerializedProperty FindProperty(string path)
        {
            for (Type t = targetObject.GetType(); t != null; t = t.BaseType)
            {
                FieldInfo field = t.GetField(path, BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic |
                                                   BindingFlags.DeclaredOnly);
                if (field != null && (field.IsPublic || field.IsDefined(typeof(SerializeField), true)))
                {
                    return new SerializedProperty(this, field);
                }
            }
            return null;
        }
    }

    public sealed class SerializedProperty
    {
        readonly FieldInfo field;
        public SerializedObject serializedObject { get; private set; }

        internal SerializedProperty(SerializedObject owner, FieldInfo field)
        {
            serializedObject = owner;
            this.field = field;
        }

        public string name { get { return field.Name; } }
        public string propertyPath { get { return field.Name; } }
        public string displayName { get { return field.Name; } }
        public bool hasMultipleDifferentValues { get { return false; } }

        object Value
        {
            get { return field.GetValue(serializedObject.targetObject); }
            set
            {
                foreach (UnityEngine.Object target in serializedObject.targetObjects)
                {
                    field.SetValue(target, value);
                }
            }
        }

        internal void CopyFrom(SerializedProperty other) { Value = other.Value; }

        public float floatValue { get { return (float)Value; } set { Value = value; } }
        public int intValue { get { return Convert.ToInt32(Value); } set { Value = value; } }
        public bool boolValue { get { return (bool)Value; } set { Value = value; } }
        public string stringValue { get { return (string)Value; } set { Value = value; } }
        public Vector2 vector2Value { get { return (Vector2)Value; } set { Value = value; } }
        public Vector3 vector3Value { get { return (Vector3)Value; } set { Value = value; } }
        public int enumValueIndex
        {
            get { return Convert.ToInt32(Value); }
            set { Value = Enum.ToObject(field.FieldType, value); }
        }
        public UnityEngine.Object objectReferenceValue
        {
            get { return (UnityEngine.Object)Value; }
            set { Value = value; }
        }
    }
}
