// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;

namespace Knurl
{
    /// <summary>Reads tags of gratings in glTF files, for importers.</summary>
    public static class KnurlTags
    {
        /// <summary>Reads a .gltf or .glb file on the disk with Knurl's own loader, in edit mode too. Main
        /// thread.</summary>
        /// <param name="path">The file; a relative path is relative to the process's working directory.</param>
        /// <returns>Its tagged surfaces, one per node and primitive, in the file's order; empty without tags.</returns>
        /// <exception cref="KnurlException">The file cannot be read or is invalid; the message names file, object and
        /// key. Or the native library is missing.</exception>
        public static unsafe IReadOnlyList<KnurlTag> Read(string path)
        {
            return Load(path, null);
        }

        /// <summary>The same of a file's content. name: for messages.</summary>
        internal static IReadOnlyList<KnurlTag> ReadContent(byte[] content, string name)
        {
            return Load(name, content);
        }

        static unsafe IReadOnlyList<KnurlTag> Load(string path, byte[] content)
        {
            Library.Demand();
            knurl_scene* scene = null;
            KnurlException.Check(NativeMethods.knurl_scene_create(null, &scene));
            try
            {
                fixed (byte* file = Utf8.Bytes(path, "path"), bytes = content)
                {
                    KnurlException.Check(content == null
                        ? NativeMethods.knurl_gltf_load_file(scene, file, null, null)
                        : NativeMethods.knurl_gltf_load_memory(scene, (IntPtr)bytes, (ulong)content.Length, file, null,
                            null, null));
                }
                return ReadAll(scene);
            }
            finally
            {
                NativeMethods.knurl_scene_destroy(scene);
            }
        }

        static unsafe KnurlTag[] ReadAll(knurl_scene* scene)
        {
            var tags = new KnurlTag[NativeMethods.knurl_scene_get_surface_count(scene)];
            for (uint i = 0; i < tags.Length; i++)
            {
                knurl_surface_info info;
                NativeMethods.knurl_surface_info_init(&info, (uint)sizeof(knurl_surface_info));
                knurl_material_desc material;
                NativeMethods.knurl_material_desc_init(&material, (uint)sizeof(knurl_material_desc));
                ulong surface = NativeMethods.knurl_scene_get_surface(scene, i);
                KnurlException.Check(NativeMethods.knurl_scene_get_surface_info(scene, surface, &info));
                KnurlException.Check(NativeMethods.knurl_scene_get_material(scene, surface, &material));
                tags[i] = new KnurlTag(&info, &material);
            }
            return tags;
        }
    }
}
