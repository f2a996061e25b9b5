// Test-only stand-ins, never shipped.
using System;
using System.Collections.Generic;
using System.Reflection;
using UnityEngine;

namespace UnityEditor
{
    /// Faithful: values are copies, taken by the constructor and Update() and written by ApplyModifiedProperties(),
    /// only changed ones; the fields that Unity serialises; values that differ between targets. Not: arrays (shared),
    /// nested
    /// paths, undo.
    public sealed class SerializedObject : IDisposable
    {
        const BindingFlags Own = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic |
                                 BindingFlags.DeclaredOnly;
        readonly Dictionary<FieldInfo, object[]> values = new Dictionary<FieldInfo, object[]>(); // of each target
        readonly HashSet<FieldInfo> modified = new HashSet<FieldInfo>();

        public UnityEngine.Object[] targetObjects { get; private set; }
        public UnityEngine.Object targetObject { get { return targetObjects[0]; } }
        public bool isEditingMultipleObjects { get { return targetObjects.Length > 1; } }

        public SerializedObject(UnityEngine.Object target) : this(new[] { target }) { }

        public SerializedObject(UnityEngine.Object[] targets)
        {
            int missing = Array.FindIndex(targets, target => target == null);
            if (missing >= 0)
            {
                throw new ArgumentException("Object at index " + missing + " is null");
            }
            targetObjects = targets;
            Update();
        }

        public void Update()
        {
            values.Clear();
            modified.Clear();
            for (Type t = targetObject.GetType(); t != null; t = t.BaseType)
            {
                foreach (FieldInfo field in t.GetFields(Own))
                {
                    bool isStored = field.IsPublic || field.IsDefined(typeof(SerializeField), true);
                    if (isStored && !field.IsNotSerialized && !field.IsInitOnly)
                    {
                        values[field] = Array.ConvertAll(targetObjects, target => field.GetValue(target));
                    }
                }
            }
        }

        public bool ApplyModifiedPropertiesWithoutUndo() { return ApplyModifiedProperties(); }
        public void Dispose() { }

        /// As in Unity, OnValidate of the targets runs if something has changed.
        public bool ApplyModifiedProperties()
        {
            bool isChanged = false;
            for (int i = 0; i < targetObjects.Length; i++)
            {
                if (Write(i))
                {
                    isChanged = true;
                    Validate(targetObjects[i]);
                }
            }
            modified.Clear();
            return isChanged;
        }

        bool Write(int index)
        {
            bool isChanged = false;
            foreach (FieldInfo field in modified)
            {
                object value = values[field][index];
                if (!Equals(field.GetValue(targetObjects[index]), value))
                {
                    field.SetValue(targetObjects[index], value);
                    isChanged = true;
                }
            }
            return isChanged;
        }

        static void Validate(UnityEngine.Object target)
        {
            MethodInfo validate = target.GetType().GetMethod("OnValidate",
                BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic);
            if (validate != null)
            {
                validate.Invoke(target, null);
            }
        }

        public void CopyFromSerializedProperty(SerializedProperty property)
        {
            if (property == null)
            {
                throw new ArgumentNullException("property");
            }
            FindProperty(property.name).CopyFrom(property);
        }

        public SerializedProperty FindProperty(string path)
        {
            foreach (FieldInfo field in values.Keys)
            {
                if (field.Name == path)
                {
                    return new SerializedProperty(this, field);
                }
            }
            return null;
        }

        internal object[] Read(FieldInfo field) { return values[field]; }

        internal void Set(FieldInfo field, object value)
        {
            values[field] = Array.ConvertAll(targetObjects, target => value);
            modified.Add(field);
        }
    }

    /// Of several targets it reads the first and writes all. Not: the words of displayName, which is the field's name.
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

        object Value
        {
            get { return serializedObject.Read(field)[0]; }
            set { serializedObject.Set(field, value); }
        }

        internal void CopyFrom(SerializedProperty other) { Value = other.Value; }

        public float floatValue { get { return (float)Value; } set { Value = value; } }
        public int intValue
        {
            get { return Convert.ToInt32(Value); }
            set { Value = field.FieldType.IsEnum ? Enum.ToObject(field.FieldType, value) : value; }
        }
        public bool boolValue { get { return (bool)Value; } set { Value = value; } }
        public string stringValue { get { return (string)Value; } set { Value = value; } }

        public UnityEngine.Object objectReferenceValue
        {
            get { return (UnityEngine.Object)Value; }
            set { Value = value; }
        }
    }
}
