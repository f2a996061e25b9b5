// Test-only stand-ins, never shipped.
using System;
using System.Collections.Generic;
using System.Globalization;
using System.Reflection;
using System.Web.Script.Serialization;

namespace UnityEngine
{
    /// Faithful: fields by their exact names, public or with SerializeField; of classes and structures only those that are
    /// Serializable; missing fields keep their constructor's value, unknown keys are ignored. Not: writing,
    /// lists, a limit of depth, an error for text that ends too early; a value of another type than its field is also
    /// ignored.
    public static class JsonUtility
    {
        public static T FromJson<T>(string json) { return (T)FromJson(json, typeof(T)); }

        public static object FromJson(string json, Type type)
        {
            if (string.IsNullOrEmpty(json))
            {
                return null;
            }
            if (type.IsAbstract || type.IsSubclassOf(typeof(Object)))
            {
                throw new ArgumentException("Cannot deserialize JSON to new instances of type '" + type.Name + ".'");
            }
            return Make(Parse(json), type);
        }

        static Dictionary<string, object> Parse(string json)
        {
            object parsed;
            try
            {
                parsed = new JavaScriptSerializer { MaxJsonLength = int.MaxValue }.DeserializeObject(json);
            }
            catch (ArgumentException e)
            {
                throw new ArgumentException("JSON parse error: " + e.Message);
            }
            var members = parsed as Dictionary<string, object>;
            if (members == null)
            {
                throw new ArgumentException("JSON must represent an object type.");
            }
            return members;
        }

        static object Make(Dictionary<string, object> members, Type type)
        {
            object made = Activator.CreateInstance(type, true);
            foreach (FieldInfo field in type.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic))
            {
                bool isStored = (field.IsPublic || field.IsDefined(typeof(SerializeField), true))
                    && !field.IsNotSerialized && !field.IsInitOnly;
                object value;
                if (isStored && members.TryGetValue(field.Name, out value))
                {
                    field.SetValue(made, Convert(value, field.FieldType) ?? field.GetValue(made));
                }
            }
            return made;
        }

        /// Null if a field of that type does not accept the value.
        static object Convert(object value, Type type)
        {
            var members = value as Dictionary<string, object>;
            var elements = value as object[];
            if (type == typeof(string))
            {
                return value as string;
            }
            if (type == typeof(bool))
            {
                return value as bool?;
            }
            if (type.IsPrimitive || type.IsEnum)
            {
                bool isNumber = value is int || value is long || value is decimal || value is double;
                Type kind = type.IsEnum ? Enum.GetUnderlyingType(type) : type;
                object number = isNumber ? System.Convert.ChangeType(value, kind, CultureInfo.InvariantCulture) : null;
                return isNumber && type.IsEnum ? Enum.ToObject(type, number) : number;
            }
            if (type.IsArray && elements != null)
            {
                return MakeArray(elements, type.GetElementType());
            }
            return members != null && type.IsSerializable && !type.IsArray ? Make(members, type) : null;
        }

        static Array MakeArray(object[] elements, Type type)
        {
            if (type.IsArray || !type.IsSerializable)
            {
                return null;
            }
            Array made = Array.CreateInstance(type, elements.Length);
            for (int i = 0; i < elements.Length; i++)
            {
                made.SetValue(Convert(elements[i], type), i);
            }
            return made;
        }
    }
}
