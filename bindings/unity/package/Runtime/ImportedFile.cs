// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Knurl
{
    /// <summary>Gives objects that an importer makes the surfaces of their tags, in the editor and in games.</summary>
    internal static class ImportedFile
    {
        static string path; // of the file that the editor imports at present; null in games
        static Func<string, int, string> extras;
        static Action<string, Object> keep;
        static readonly HashSet<string> kept = new HashSet<string>();

        /// <summary>The editor imports a file from now on. extrasOf: the extras of its object by "nodes", "meshes" or
        /// "materials" and index, as a JSON object, or null if that has no tag; null if the importer knows them. toKeep: adds
        /// an object to the imported asset, under an identifier.</summary>
        internal static void Begin(string file, Func<string, int, string> extrasOf, Action<string, Object> toKeep)
        {
            path = file;
            extras = extrasOf;
            keep = toKeep;
            kept.Clear();
        }

        internal static void End()
        {
            Begin(null, null, null);
        }

        /// <summary>See <see cref="Begin"/>; null in games.</summary>
        internal static string ExtrasOf(string array, int index)
        {
            return extras == null || index < 0 ? null : extras(array, index);
        }

        /// <summary>Reads a tag and attaches it; a wrong one is a warning. named: the object of the node. owners: the objects
        /// that show its mesh; several if it is instanced. The other arguments are those of <see cref="TagDocument.Read"/>.
        /// Returns true if they have a surface now.</summary>
        internal static bool Attach(GameObject named, IReadOnlyList<GameObject> owners, string node, string mesh, string material,
            bool isDoubleSided)
        {
            try
            {
                KnurlTag tag = Library.Check() != null && path == null ? null // a game without the library stays silent
                    : TagDocument.Read(path ?? "glTF", named.name, node, mesh, material, isDoubleSided);
                return tag != null && Attach(owners, tag);
            }
            catch (KnurlException exception)
            {
                Warn(exception.Message, named);
                return false;
            }
        }

        /// <summary>Returns false after a warning that the object has no mesh.</summary>
        static bool Attach(IReadOnlyList<GameObject> owners, KnurlTag tag)
        {
            KnurlGrating grating = null; // of all of them
            foreach (GameObject owner in owners)
            {
                if (owner.GetComponent<MeshFilter>() == null)
                {
                    Warn((path == null ? "" : path + ": ") + "'" + owner.name + "' has a tag but no MeshFilter: tag objects that "
                        + "have a mesh without bones and blend shapes", owner);
                    return false;
                }
                if (owner.GetComponent<KnurlSurface>() == null)
                {
                    grating = grating == null ? tag.MakeGrating(owner.name) : grating;
                    tag.CopyTo(owner.AddComponent<KnurlSurface>(), grating, tag.Axis);
                }
            }
            if (grating != null)
            {
                Keep(grating, "Knurl " + PathOf(owners[0].transform));
            }
            return true;
        }

        /// <summary>Identifiers stay the same when a file is imported again, so that references to a grating do.</summary>
        static void Keep(KnurlGrating grating, string identifier)
        {
            string unique = identifier;
            for (int i = 2; keep != null && !kept.Add(unique); i++)
            {
                unique = identifier + " (" + i + ")";
            }
            if (keep != null)
            {
                keep(unique, grating);
            }
        }

        static string PathOf(Transform of)
        {
            return of.parent == null ? of.name : PathOf(of.parent) + "/" + of.name;
        }

        static void Warn(string sentence, GameObject owner)
        {
            Debug.LogWarning("Knurl: " + sentence, owner);
        }
    }
}
