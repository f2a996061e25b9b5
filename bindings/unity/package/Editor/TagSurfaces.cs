// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Linq;
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Adds the tagged surfaces of a glTF file to the objects that an importer made from it. Objects are found
    /// by the names of objects and meshes, which all importers keep; only a single root becomes the asset's main
    /// object, which Unity names after the file.</summary>
    internal static class TagSurfaces
    {
        const string PartMark = " / "; // Knurl's names are "node / material" if a mesh has several primitives

        /// <summary>Kinds of matches between an object's names and a tag, the most certain first.</summary>
        enum Match
        {
            ObjectAndMesh,
            Object,
            Mesh,
        }

        /// <summary>Adds or updates a KnurlSurface on the object of each tag at or below root. gratings: one for each
        /// tag, or null. names: of the file. One undo step. Returns the tags that could not be placed, one sentence
        /// each.</summary>
        internal static List<string> Apply(GameObject root, IReadOnlyList<KnurlTag> tags,
            IReadOnlyList<KnurlGrating> gratings, GltfNames names)
        {
            var meshes = root.GetComponentsInChildren<MeshFilter>(true);
            var found = new GameObject[tags.Count];
            var used = new Dictionary<GameObject, string>();
            foreach (Match match in Enum.GetValues(typeof(Match)))
            {
                for (int i = 0; i < tags.Count; i++)
                {
                    if (found[i] == null && gratings[i] != null)
                    {
                        Take(Find(meshes, tags[i].Name, names, match, used), tags[i].Name, out found[i], used);
                    }
                }
            }
            if (tags.Count == 1 && meshes.Length == 1)
            {
                found[0] = meshes[0].gameObject; // whatever its name is
            }
            return Place(root, tags, gratings, meshes, found, used);
        }

        static void Take(GameObject owner, string tag, out GameObject found, Dictionary<GameObject, string> used)
        {
            found = owner;
            if (owner != null)
            {
                used.Add(owner, tag);
            }
        }

        static List<string> Place(GameObject root, IReadOnlyList<KnurlTag> tags, IReadOnlyList<KnurlGrating> gratings,
            MeshFilter[] meshes, GameObject[] found, Dictionary<GameObject, string> used)
        {
            var missed = new List<string>();
            for (int i = 0; i < tags.Count; i++)
            {
                if (gratings[i] == null)
                {
                    missed.Add("'" + tags[i].Name + "' has no grating: read the file's tags again");
                }
                else if (found[i] == null)
                {
                    missed.Add(Explain(root, tags[i].Name, meshes, used));
                }
                else
                {
                    Put(found[i], gratings[i], tags[i]);
                }
            }
            return missed;
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

        static void Put(GameObject owner, KnurlGrating grating, KnurlTag tag)
        {
            var surface = owner.GetComponent<KnurlSurface>();
            if (surface == null)
            {
                surface = Undo.AddComponent<KnurlSurface>(owner);
            }
            Undo.RecordObject(surface, "Add Knurl Surfaces");
            surface.Grating = grating;
            surface.DoubleSided = tag.DoubleSided;
            surface.Smooth = tag.Smooth;
            if (tag.Axis != Vector3.zero) // otherwise it keeps its own
            {
                surface.Axis = Axes.ToMesh(tag.Axis, owner.transform.localToWorldMatrix);
            }
            surface.BoxCoordinates = tag.BoxCoordinates && surface.Axis == Vector3.zero;
            if (PrefabUtility.IsPartOfPrefabInstance(surface))
            {
                PrefabUtility.RecordPrefabInstancePropertyModifications(surface);
            }
        }
    }
}
