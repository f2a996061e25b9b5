// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Linq;
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Puts the tagged surfaces of a glTF file onto the objects that an importer made of it: by name, for that
    /// is what all importers keep.</summary>
    internal static class TagSurfaces
    {
        const string PartMark = " / "; // Knurl's names are "node / material" where a mesh has several primitives

        /// <summary>Adds a KnurlSurface, or updates the one that is there, on each object at or below root whose name
        /// is a tag's. gratings: one for each tag, or null. Can be undone in one step. Returns what could not be
        /// placed, a sentence each.</summary>
        internal static List<string> Apply(GameObject root, IReadOnlyList<KnurlTag> tags,
            IReadOnlyList<KnurlGrating> gratings)
        {
            var missed = new List<string>();
            var meshes = root.GetComponentsInChildren<MeshFilter>(true);
            var used = new Dictionary<GameObject, string>();
            for (int i = 0; i < tags.Count; i++)
            {
                GameObject found = Find(meshes, tags[i].Name, used);
                if (gratings[i] == null)
                {
                    missed.Add("'" + tags[i].Name + "' has no grating: read the file's tags again");
                }
                else if (found == null)
                {
                    missed.Add(Explain(root, tags[i].Name, meshes, used));
                }
                else
                {
                    used.Add(found, tags[i].Name);
                    Put(found, gratings[i], tags[i]);
                }
            }
            return missed;
        }

        /// <summary>The first object of that name that is not taken; without the number that Knurl puts behind names
        /// that come twice; without the material's.</summary>
        static GameObject Find(MeshFilter[] meshes, string name, Dictionary<GameObject, string> used)
        {
            foreach (string candidate in Candidates(name))
            {
                MeshFilter found = meshes.FirstOrDefault(mesh => mesh.gameObject.name == candidate
                    && !used.ContainsKey(mesh.gameObject));
                if (found != null)
                {
                    return found.gameObject;
                }
            }
            return null;
        }

        internal static IEnumerable<string> Candidates(string name)
        {
            yield return name;
            string once = WithoutNumber(name);
            if (once != name)
            {
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
            if (tag.Axis != Vector3.zero) // else it may have one of its own
            {
                surface.Axis = Axes.ToMesh(tag.Axis, owner.transform.localToWorldMatrix);
            }
            if (PrefabUtility.IsPartOfPrefabInstance(surface))
            {
                PrefabUtility.RecordPrefabInstancePropertyModifications(surface);
            }
        }
    }
}
