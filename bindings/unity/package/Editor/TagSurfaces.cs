// SPDX-License-Identifier: MIT
using System.Collections.Generic;
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Adds the tagged surfaces of a glTF file to an instance of its objects, with undo: for importers that do not
    /// attach them by themselves.</summary>
    internal static class TagSurfaces
    {
        /// <summary>Adds or updates a KnurlSurface on the object of each tag at or below root. gratings: one for each
        /// tag, or null. Returns the tags that could not be placed, one sentence each.</summary>
        internal static List<string> Apply(GameObject root, IReadOnlyList<KnurlTag> tags,
            IReadOnlyList<KnurlGrating> gratings)
        {
            var without = new List<string>();
            List<string> missed = TagPlacer.Place(root, tags, (owner, i) =>
            {
                if (gratings[i] == null)
                {
                    without.Add("'" + tags[i].Name + "' has no grating: read the file's tags again");
                }
                else
                {
                    Put(owner, gratings[i], tags[i]);
                }
            });
            missed.AddRange(without);
            return missed;
        }

        static void Put(GameObject owner, KnurlGrating grating, KnurlTag tag)
        {
            var surface = owner.GetComponent<KnurlSurface>();
            if (surface == null)
            {
                surface = Undo.AddComponent<KnurlSurface>(owner);
            }
            Undo.RecordObject(surface, "Add Knurl Surfaces");
            tag.CopyTo(surface, grating, tag.AxisIn(PlaceInFile(owner)));
            if (PrefabUtility.IsPartOfPrefabInstance(surface))
            {
                PrefabUtility.RecordPrefabInstancePropertyModifications(surface);
            }
        }

        /// <summary>An instance may have been scaled since it was made; the imported object was not.</summary>
        static Matrix4x4 PlaceInFile(GameObject owner)
        {
            GameObject imported = PrefabUtility.GetCorrespondingObjectFromOriginalSource(owner);
            return (imported == null ? owner : imported).transform.localToWorldMatrix;
        }
    }
}
