// SPDX-License-Identifier: MIT
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Text;

namespace Knurl
{
    /// <summary>Reads the tag of one imported object with Knurl's own loader: as the tag of a triangle's node, mesh and
    /// material in a glTF file that is made for it. So an axis stays in the mesh's axes, whatever the scale of the
    /// object.</summary>
    internal static class TagDocument
    {
        const string Word = "knurl"; // in each tag

        /// <summary>Keys of extras that belong to a tag: the nested form, and the flat one's (assets/knurl_extras.schema.json
        /// of Knurl).</summary>
        internal static readonly string[] Keys =
        {
            Word, "knurl_version", "knurl_spatial_frequency", "knurl_amplitude", "knurl_stiffness", "knurl_damping",
            "knurl_friction", "knurl_orientation", "knurl_axis", "knurl_coordinates", "knurl_method", "knurl_smooth",
        };

        // The UVs keep the loader from choosing box coordinates by itself.
        const string Triangle = "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
            + "{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"}],"
            + "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":12,\"byteLength\":24}],"
            + "\"buffers\":[{\"byteLength\":36,"
            + "\"uri\":\"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]";

        /// <summary>Returns null if nothing is tagged. name: of the object. file: for messages. node, mesh, material:
        /// their extras, each a JSON object, or null. isDoubleSided: of the material.</summary>
        /// <exception cref="KnurlException">A wrong tag; the message names file, object and key.</exception>
        internal static KnurlTag Read(string file, string name, string node, string mesh, string material,
            bool isDoubleSided)
        {
            if (!new[] { node, mesh, material }.Any(extras => extras != null && extras.Contains(Word)))
            {
                return null;
            }
            string quoted = "{\"name\":" + Quoted(name);
            string text = "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[" + quoted + ",\"mesh\":0" + Extras(node) + "}],"
                + "\"meshes\":[" + quoted + Extras(mesh) + ",\"primitives\":[{\"attributes\":{\"POSITION\":0,"
                + "\"TEXCOORD_0\":1},\"material\":0}]}],\"materials\":[" + quoted + Extras(material)
                + (isDoubleSided ? ",\"doubleSided\":true" : "") + "}]," + Triangle + "}";
            IReadOnlyList<KnurlTag> tags = KnurlTags.Read(Encoding.UTF8.GetBytes(text), file);
            return tags.Count > 0 ? tags[0] : null; // the word may stand in somebody else's property
        }

        static string Extras(string json)
        {
            return json == null ? "" : ",\"extras\":" + json;
        }

        internal static string Quoted(string text)
        {
            var quoted = new StringBuilder("\"");
            foreach (char c in text)
            {
                quoted.Append(c == '"' || c == '\\' ? "\\" + c
                    : c < 32 ? "\\u" + ((int)c).ToString("x4", CultureInfo.InvariantCulture) : c.ToString());
            }
            return quoted.Append('"').ToString();
        }
    }
}
