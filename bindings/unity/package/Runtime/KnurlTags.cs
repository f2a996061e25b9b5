// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.IO;
using System.Runtime.InteropServices;
using UnityEngine;

namespace Knurl
{
    /// <summary>Reads tags of gratings in glTF files, and gives loaded objects their surfaces: for importers, and for
    /// games that load files.</summary>
    public static class KnurlTags
    {
        /// <summary>Reads a .gltf or .glb file on the disk with Knurl's own loader, in edit mode too. Main
        /// thread.</summary>
        /// <param name="path">The file; a relative path is relative to the process's working directory.</param>
        /// <returns>Its tagged surfaces, one per node and primitive, in the file's order; empty without tags.</returns>
        /// <exception cref="KnurlException">The file cannot be read or is invalid; the message names file, object and
        /// key. Or the native library is missing.</exception>
        public static IReadOnlyList<KnurlTag> Read(string path)
        {
            KnurlTag[] tags = Load(path, null);
            if (tags.Length > 0)
            {
                Name(tags, GltfText.ReadJson(path), path);
            }
            return tags;
        }

        /// <summary>The same of a file's content, which has to be whole: external buffers are refused. Main
        /// thread.</summary>
        /// <param name="content">The bytes of a .gltf or .glb file, read during the call.</param>
        /// <param name="name">The file's name, for messages and to find its only root.</param>
        /// <returns>As <see cref="Read(string)"/>.</returns>
        /// <exception cref="KnurlException">As <see cref="Read(string)"/>.</exception>
        /// <exception cref="ArgumentNullException">content is null.</exception>
        public static IReadOnlyList<KnurlTag> Read(byte[] content, string name)
        {
            if (content == null)
            {
                throw new ArgumentNullException("content");
            }
            KnurlTag[] tags = Load(name, content);
            if (tags.Length > 0)
            {
                using (var stream = new MemoryStream(content, false))
                {
                    Name(tags, GltfText.ReadJson(stream), name);
                }
            }
            return tags;
        }

        /// <summary>Gives the objects that a game has loaded from a glTF file the surfaces of the file's tags: call it once
        /// all of the file's objects are there, before they are scaled. Objects are found by the names of objects and
        /// meshes. An object that has a surface is updated. Main thread.</summary>
        /// <param name="root">The objects are at or below it.</param>
        /// <param name="tags">Of <see cref="Read(string)"/>, from the same file.</param>
        /// <returns>The tags that could not be placed, one sentence each; empty if all were.</returns>
        /// <exception cref="ArgumentNullException">root or tags is null.</exception>
        public static IReadOnlyList<string> Apply(GameObject root, IReadOnlyList<KnurlTag> tags)
        {
            if (root == null || tags == null)
            {
                throw new ArgumentNullException(root == null ? "root" : "tags");
            }
            Transform above = root.transform.parent;
            Matrix4x4 toFile = above == null ? Matrix4x4.identity : above.worldToLocalMatrix;
            return TagPlacer.Place(root, tags, (owner, i) =>
            {
                var surface = owner.GetComponent<KnurlSurface>();
                surface = surface == null ? owner.AddComponent<KnurlSurface>() : surface;
                tags[i].CopyTo(surface, tags[i].MakeGrating(tags[i].Name),
                    tags[i].AxisIn(toFile * owner.transform.localToWorldMatrix));
            });
        }

        static void Name(KnurlTag[] tags, string json, string path)
        {
            var names = new GltfNames(json, path);
            foreach (KnurlTag tag in tags)
            {
                tag.Names = names;
            }
        }

        static unsafe KnurlTag[] Load(string path, byte[] content)
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

#if UNITY_EDITOR
        /// <summary>The tags of a file's "nodes", "meshes" and "materials", as the extras {"knurl": tag} of "nodes 3" and
        /// so on.</summary>
        internal static unsafe Dictionary<string, string> List(byte[] content, string name)
        {
            Library.Demand();
            var found = new Dictionary<string, string>();
            knurl_gltf_list_callback each = (user, array, index, owner, tag) =>
            {
                if (tag != null)
                {
                    found[Utf8.Read(array) + " " + index] = "{\"knurl\":" + Utf8.Read(tag) + "}";
                }
            };
            fixed (byte* bytes = content, file = Utf8.Bytes(name, "name"))
            {
                KnurlException.Check(NativeMethods.knurl_gltf_list_tags((IntPtr)bytes, (ulong)content.Length, file,
                    Marshal.GetFunctionPointerForDelegate(each), IntPtr.Zero));
            }
            GC.KeepAlive(each);
            return found;
        }
#endif
    }
}
