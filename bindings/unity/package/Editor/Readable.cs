// SPDX-License-Identifier: MIT
using System;
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Read/Write of meshes, where the project's own import settings say it.</summary>
    internal static class Readable
    {
        // Of importers that are not Unity's own: UnityGLTF's field.
        const string Field = "_readWriteEnabled";

        /// <summary>Whether a mesh that cannot be read can be made readable here.</summary>
        internal static bool CanMake(Mesh mesh)
        {
            AssetImporter importer = Find(mesh);
            return importer is ModelImporter || FieldOf(importer) != null;
        }

        internal static void Make(Mesh mesh)
        {
            AssetImporter importer = Find(mesh);
            var model = importer as ModelImporter;
            SerializedProperty field = FieldOf(importer);
            if (model != null)
            {
                model.isReadable = true;
            }
            else if (field != null)
            {
                field.boolValue = true;
                field.serializedObject.ApplyModifiedPropertiesWithoutUndo();
            }
            importer.SaveAndReimport();
        }

        static AssetImporter Find(Mesh mesh)
        {
            string path = mesh == null || mesh.isReadable ? "" : AssetDatabase.GetAssetPath(mesh);
            return path.StartsWith("Assets/", StringComparison.Ordinal) ? AssetImporter.GetAtPath(path) : null;
        }

        static SerializedProperty FieldOf(AssetImporter importer)
        {
            return importer == null || importer is ModelImporter ? null
                : new SerializedObject(importer).FindProperty(Field);
        }
    }
}
