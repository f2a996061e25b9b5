// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Text.RegularExpressions;
using System.Xml.Linq;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>Knurl is the same in both engines: names, defaults and units match the class reference of Godot's
    /// extension, except for names that Unity uses otherwise.</summary>
    [TestFixture]
    public class GodotTests : Suite
    {
        // Godot's name: Unity's.
        static readonly Dictionary<string, string> Renamed = new Dictionary<string, string>
        {
            { "start", "StartDevice" }, // Start is a message of Unity's
            { "stop", "StopDevice" },
            { "get_touched_surface", "Touched" },
            { "get_triangle_count", "TriangleCount" },
            { "is_touched", "IsTouched" },
            { "enabled", "enabled" } // Behaviour's
        };

        static string Name(string godot)
        {
            string name;
            return Renamed.TryGetValue(godot, out name) ? name
                : string.Concat(godot.Split('_').Select(p => char.ToUpperInvariant(p[0]) + p.Substring(1)).ToArray());
        }

        static XElement Reference(Type type)
        {
            return XDocument.Load(Path.Combine(Repository.Root, "bindings/godot/doc_classes", type.Name + ".xml")).Root;
        }

        UnityEngine.Object Make(Type type)
        {
            return typeof(ScriptableObject).IsAssignableFrom(type)
                ? Made<UnityEngine.Object>(ScriptableObject.CreateInstance(type))
                : MakeObject("Any").AddComponent(type);
        }

        static object Parse(string text, Type type)
        {
            double[] numbers = Regex.Matches(text, @"(?<![A-Za-z])-?[0-9.]+").Cast<Match>()
                .Select(m => double.Parse(m.Value, CultureInfo.InvariantCulture)).ToArray();
            if (type == typeof(string))
            {
                return text.Trim('"');
            }
            if (type == typeof(bool))
            {
                return text == "true";
            }
            if (type == typeof(Vector2))
            {
                return new Vector2((float)numbers[0], (float)numbers[1]);
            }
            if (type == typeof(Vector3))
            {
                return new Vector3((float)numbers[0], (float)numbers[1], (float)numbers[2]);
            }
            if (type == typeof(Quaternion))
            {
                return new Quaternion((float)numbers[0], (float)numbers[1], (float)numbers[2], (float)numbers[3]);
            }
            return type.IsEnum ? Enum.ToObject(type, (int)numbers[0]) : Convert.ChangeType(numbers[0], type);
        }

        [TestCase(typeof(KnurlGrating), 7)]
        [TestCase(typeof(KnurlSurface), 4)]
        [TestCase(typeof(KnurlDevice), 17)]
        public void PropertiesHaveGodotsNamesAndDefaults(Type type, int least)
        {
            UnityEngine.Object made = Make(type);
            int count = 0;
            foreach (XElement member in Reference(type).Element("members").Elements("member"))
            {
                string name = (string)member.Attribute("name");
                if (name == "rumble") // Unity's gamepads are in a package of their own, the Input System
                {
                    continue;
                }
                PropertyInfo property = type.GetProperty(Name(name));
                Assert.That(property, Is.Not.Null, name + " as " + Name(name));
                Assert.AreEqual((string)member.Attribute("setter") != "", property.GetSetMethod() != null,
                    name + " can be set");
                if (member.Attribute("default") != null)
                {
                    object expected = property.PropertyType == typeof(TextAsset) ? null // a file's path in Godot
                        : Parse((string)member.Attribute("default"), property.PropertyType);
                    object found = property.GetValue(made, null);
                    Assert.AreEqual(expected, found, name);
                }
                count++;
            }
            Assert.That(count, Is.GreaterThanOrEqualTo(least));
        }

        [TestCase(typeof(KnurlSurface), 3)]
        [TestCase(typeof(KnurlDevice), 7)]
        public void MethodsHaveGodotsNames(Type type, int least)
        {
            int count = 0;
            foreach (XElement method in Reference(type).Element("methods").Elements("method"))
            {
                string name = Name((string)method.Attribute("name"));
                Assert.That(type.GetMethod(name) != null || type.GetProperty(name) != null, type.Name + "." + name);
                count++;
            }
            Assert.That(count, Is.GreaterThanOrEqualTo(least));
        }

        [Test]
        public void SignalsAreEventsOfTheSameNames()
        {
            List<string> signals = Reference(typeof(KnurlDevice)).Element("signals").Elements("signal")
                .Select(s => Name((string)s.Attribute("name"))).ToList();
            Assert.AreEqual(5, signals.Count);
            foreach (string signal in signals)
            {
                FieldInfo field = typeof(KnurlDevice).GetField(char.ToLowerInvariant(signal[0]) + signal.Substring(1));
                Assert.That(field, Is.Not.Null, signal);
                Assert.That(typeof(UnityEngine.Events.UnityEventBase).IsAssignableFrom(field.FieldType), signal);
                Assert.That(field.FieldType.IsDefined(typeof(SerializableAttribute), false), signal);
            }
        }

        [TestCase(typeof(KnurlGrating), "grating.c", 4)]
        [TestCase(typeof(KnurlDevice), "device_class.c", 1)]
        public void UnitsAreGodots(Type type, string source, int least)
        {
            string text = File.ReadAllText(Path.Combine(Repository.Root, "bindings/godot/src", source));
            int count = 0;
            // NUMBER(name, ...) or {"name", ...}, as far as its hint.
            foreach (Match row in Regex.Matches(text, @"(?:NUMBER\((\w+)|\{""(\w+)"")[^{}]*?suffix:([^""]+)"""))
            {
                string name = row.Groups[1].Success ? row.Groups[1].Value : row.Groups[2].Value,
                    unit = row.Groups[3].Value;
                string own = char.ToLowerInvariant(Name(name)[0]) + Name(name).Substring(1);
                FieldInfo field = type.GetField(own, BindingFlags.Instance | BindingFlags.NonPublic);
                Assert.That(field, Is.Not.Null, own);
                var tip = (TooltipAttribute)field.GetCustomAttributes(typeof(TooltipAttribute), false).Single();
                Assert.That(tip.tooltip.EndsWith(" " + unit),
                    own + ": expected " + unit + " at the end of '" + tip.tooltip + "'");
                count++;
            }
            Assert.That(count, Is.GreaterThanOrEqualTo(least));
        }

        [Test]
        public void AllThatIsSetIsSerializedAndHasATooltip()
        {
            foreach (Type type in new[] { typeof(KnurlGrating), typeof(KnurlSurface), typeof(KnurlDevice) })
            {
                foreach (PropertyInfo property in type.GetProperties(BindingFlags.Instance | BindingFlags.Public |
                                                                     BindingFlags.DeclaredOnly))
                {
                    if (property.GetSetMethod() == null)
                    {
                        continue;
                    }
                    string own = char.ToLowerInvariant(property.Name[0]) + property.Name.Substring(1);
                    FieldInfo field = type.GetField(own, BindingFlags.Instance | BindingFlags.NonPublic);
                    Assert.That(field != null && field.IsDefined(typeof(SerializeField), false), type.Name + "." + own);
                    Assert.That(field.IsDefined(typeof(TooltipAttribute), false), type.Name + "." + own);
                }
            }
        }
    }
}
