// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Linq;
using UnityEngine;

namespace Knurl
{
    /// <summary>Finds the objects of a glTF file's tags among those that an importer made of it: by the names of objects
    /// and meshes, which all importers keep; only a single root becomes the asset's main object, which Unity names after
    /// the file.</summary>
    internal static class TagPlacer
    {
        const string PartMark = " / "; // Knurl's names are "node / material" if a mesh has several primitives

        /// <summary>Kinds of matches between an object's names and a tag, the most certain first.</summary>
        enum Match
        {
            ObjectAndMesh,
            Object,
            Mesh,
        }

        /// <summary>Calls put with the object of each tag at or below root, and the tag's index. tags: of one file.
        /// Returns the tags that have no object, one sentence each.</summary>
        internal static List<string> Place(GameObject root, IReadOnlyList<KnurlTag> tags, Action<GameObject, int> put)
        {
            var meshes = root.GetComponentsInChildren<MeshFilter>(true);
            var found = new GameObject[tags.Count];
            var used = new Dictionary<GameObject, string>();
            foreach (Match match in Enum.GetValues(typeof(Match)))
            {
                for (int i = 0; i < tags.Count; i++)
                {
                    if (found[i] == null)
                    {
                        Take(Find(meshes, tags[i].Name, tags[i].Names, match, used), tags[i].Name, out found[i], used);
                    }
                }
            }
            if (tags.Count == 1 && meshes.Length == 1)
            {
                found[0] = meshes[0].gameObject; // whatever its name is
            }
            var missed = new List<string>();
            for (int i = 0; i < tags.Count; i++)
            {
                if (found[i] == null)
                {
                    missed.Add(Explain(root, tags[i].Name, meshes, used));
                }
                else
                {
                    put(found[i], i);
                }
            }
            return missed;
        }

        static void Take(GameObject owner, string tag, out GameObject found, Dictionary<GameObject, string> used)
        {
            found = owner;
            if (owner != null)
            {
                used.Add(owner, tag);
            }
        }

        /// <summary>The first matching object that is not used yet.</summary>
        static GameObject Find(MeshFilter[] meshes, string tag, GltfNames names, Match match,
            Dictionary<GameObject, string> used)
        {
            HashSet<string> own = names.MeshesOf(Candidates(tag).Last());
            string material = MaterialOf(tag);
            bool isShown = meshes.Any(mesh => Shows(mesh, material)); // otherwise importers have other materials
            IEnumerable<MeshFilter> free = meshes.Where(mesh => !used.ContainsKey(mesh.gameObject)
                && (!isShown || Shows(mesh, material)));
            if (match != Match.Object)
            {
                free = free.Where(mesh => mesh.sharedMesh != null && own.Contains(mesh.sharedMesh.name));
            }
            if (match == Match.Mesh)
            {
                return First(free.Where(mesh => !names.IsNode(mesh.gameObject.name)));
            }
            return Candidates(tag).Select(name => First(free.Where(mesh => mesh.gameObject.name == name)))
                .FirstOrDefault(owner => owner != null);
        }

        static GameObject First(IEnumerable<MeshFilter> meshes)
        {
            MeshFilter first = meshes.FirstOrDefault();
            return first == null ? null : first.gameObject;
        }

        /// <summary>"Steel" of "Plate / Steel (2)"; null if the tag is for the whole mesh.</summary>
        static string MaterialOf(string tag)
        {
            string once = WithoutNumber(tag);
            int mark = once.IndexOf(PartMark, StringComparison.Ordinal);
            return mark > 0 ? once.Substring(mark + PartMark.Length) : null;
        }

        static bool Shows(MeshFilter mesh, string material)
        {
            var drawn = mesh.GetComponent<Renderer>();
            return material != null && drawn != null
                && drawn.sharedMaterials.Any(shown => shown != null && shown.name == material);
        }

        /// <summary>Possible names of a tag's object: the tag's name; without the number that Knurl appends to repeated
        /// names, or with glTFast's number, which starts at the second one; without the material's name.</summary>
        internal static IEnumerable<string> Candidates(string name)
        {
            yield return name;
            string once = WithoutNumber(name);
            if (once != name)
            {
                yield return once + "_" + (int.Parse(name.Substring(once.Length).Trim(' ', '(', ')')) - 2);
                yield return once;
            }
            int mark = once.IndexOf(PartMark, StringComparison.Ordinal);
            if (mark > 0)
            {
                yield return once.Substring(0, mark);
            }
        }

        /// <summary>"Plate" of "Plate (2)".</summary>
        internal static string WithoutNumber(string name)
        {
            int open = name.LastIndexOf(" (", StringComparison.Ordinal);
            int number;
            bool numbered = open > 0 && name.EndsWith(")", StringComparison.Ordinal)
                && int.TryParse(name.Substring(open + 2, name.Length - open - 3), out number);
            return numbered ? name.Substring(0, open) : name;
        }

        static string Explain(GameObject root, string name, MeshFilter[] meshes, Dictionary<GameObject, string> used)
        {
            string last = Candidates(name).Last();
            MeshFilter taken = meshes.FirstOrDefault(mesh => mesh.gameObject.name == last);
            return taken == null
                ? "'" + name + "' has no object with a mesh of that name at or below '" + root.name + "'"
                : "'" + name + "' shares its object with '" + used[taken.gameObject] + "': a KnurlSurface is felt over "
                    + "all of a mesh; give each material a mesh of its own";
        }
    }
}
