// SPDX-License-Identifier: MIT
using System;
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Makes meshes readable, if the project's import settings control it.</summary>
    internal static class Readable
    {
        // UnityGLTF's field, for a mesh that Unity's own importer did not import.
        const string Field = "_readWriteEnabled";

        /// <summary>True if an unreadable mesh can be made readable here.</summary>
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
