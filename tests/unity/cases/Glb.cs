// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.IO;
using System.Text;
using System.Web.Script.Serialization;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>A .glb, read without Knurl: as much of the format as the demo assets use.</summary>
    internal sealed class Glb
    {
        readonly byte[] data;
        readonly int begin; // of the binary chunk

        internal readonly Dictionary<string, object> Json;

        internal Glb(string path)
        {
            data = File.ReadAllBytes(path);
            int length = BitConverter.ToInt32(data, 12);
            begin = 28 + length;
            var reader = new JavaScriptSerializer { MaxJsonLength = int.MaxValue };
            Json = (Dictionary<string, object>)reader.DeserializeObject(Encoding.UTF8.GetString(data, 20, length));
        }

        internal static Dictionary<string, object> Object(object value)
        {
            return (Dictionary<string, object>)value;
        }

        internal object[] Array(string key)
        {
            return (object[])Json[key];
        }

        static int Number(Dictionary<string, object> from, string key)
        {
            object value;
            return from.TryGetValue(key, out value) ? Convert.ToInt32(value) : 0;
        }

        /// <summary>The start of an accessor's data, and its number of elements.</summary>
        int Open(int accessor, out int count)
        {
            Dictionary<string, object> a = Object(Array("accessors")[accessor]);
            Dictionary<string, object> view = Object(Array("bufferViews")[Number(a, "bufferView")]);
            if (view.ContainsKey("byteStride"))
            {
                throw new NotSupportedException("interleaved data");
            }
            count = Number(a, "count");
            return begin + Number(view, "byteOffset") + Number(a, "byteOffset");
        }

        internal float[] Floats(int accessor, int width)
        {
            int count, at = Open(accessor, out count);
            var values = new float[count * width];
            Buffer.BlockCopy(data, at, values, 0, 4 * values.Length);
            return values;
        }

        internal int[] Indices(int accessor)
        {
            int count, at = Open(accessor, out count);
            bool isShort = Number(Object(Array("accessors")[accessor]), "componentType") == 5123;
            var values = new int[count];
            for (int i = 0; i < count; i++)
            {
                values[i] = isShort ? BitConverter.ToUInt16(data, at + 2 * i) : BitConverter.ToInt32(data, at + 4 * i);
            }
            return values;
        }

        internal sealed class Tagged
        {
            internal string Name;
            internal Vector3 Translation;
            internal Dictionary<string, object> Primitive;
            internal Dictionary<string, object> Tag; // with the keys of "knurl", in either form
            internal bool IsDoubleSided;
        }

        /// <summary>Nodes with a primitive whose material carries a tag.</summary>
        internal List<Tagged> Surfaces()
        {
            var found = new List<Tagged>();
            foreach (object each in Array("nodes"))
            {
                Dictionary<string, object> node = Object(each);
                if (!node.ContainsKey("mesh"))
                {
                    continue;
                }
                if (node.ContainsKey("rotation") || node.ContainsKey("scale") || node.ContainsKey("matrix") ||
                    node.ContainsKey("children"))
                {
                    throw new NotSupportedException("nodes that are turned or scaled");
                }
                foreach (object primitive in (object[])Object(Array("meshes")[Number(node, "mesh")])["primitives"])
                {
                    Dictionary<string, object> material =
                        Object(Array("materials")[Number(Object(primitive), "material")]);
                    Dictionary<string, object> tag = Tag(material);
                    if (tag.Count > 0)
                    {
                        found.Add(new Tagged
                        {
                            Name = (string)node["name"], Primitive = Object(primitive), Tag = tag,
                            Translation = node.ContainsKey("translation") ? Vector((object[])node["translation"])
                                : Vector3.zero,
                            IsDoubleSided = material.ContainsKey("doubleSided") && (bool)material["doubleSided"]
                        });
                    }
                }
            }
            return found;
        }

        static Vector3 Vector(object[] values)
        {
            return new Vector3(Convert.ToSingle(values[0]), Convert.ToSingle(values[1]), Convert.ToSingle(values[2]));
        }

        static Dictionary<string, object> Tag(Dictionary<string, object> material)
        {
            var tag = new Dictionary<string, object>();
            object extras;
            if (!material.TryGetValue("extras", out extras))
            {
                return tag;
            }
            foreach (KeyValuePair<string, object> pair in Object(extras))
            {
                if (pair.Key == "knurl")
                {
                    return Object(pair.Value);
                }
                if (pair.Key.StartsWith("knurl_", StringComparison.Ordinal))
                {
                    tag.Add(pair.Key.Substring(6), pair.Value);
                }
            }
            return tag;
        }

        internal static double Value(Dictionary<string, object> tag, string key, double otherwise)
        {
            return tag.ContainsKey(key) ? Convert.ToDouble(tag[key]) : otherwise;
        }

        internal static Vector2 Frequency(Dictionary<string, object> tag)
        {
            var pair = tag["spatial_frequency"] as object[];
            return pair == null ? new Vector2(Convert.ToSingle(tag["spatial_frequency"]), 0f)
                : new Vector2(Convert.ToSingle(pair[0]), Convert.ToSingle(pair[1]));
        }
    }
}
