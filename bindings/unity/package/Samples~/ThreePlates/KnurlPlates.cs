// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl.Samples
{
    /// <summary>Three square plates side by side, each with a grating and its stripes.</summary>
    internal static class KnurlPlates
    {
        internal const float Side = 0.048f; // m
        const float Pitch = 0.054f; // m from plate to plate: together a Touch's 160 mm

        internal static void Make(Transform parent)
        {
            MakeOne(parent, 0, "Ridges of 1 mm", new Vector2(1000f, 0f), 0f);
            MakeOne(parent, 1, "Grid of 2 mm", new Vector2(500f, 500f), 0f);
            MakeOne(parent, 2, "Knurl of 1 mm", new Vector2(1000f, 1000f), 0.25f * Mathf.PI);
        }

        /// <summary>frequency: 1/m; orientation: rad.</summary>
        static void MakeOne(Transform parent, int place, string title, Vector2 frequency, float orientation)
        {
            var grating = ScriptableObject.CreateInstance<KnurlGrating>();
            grating.name = title;
            grating.SpatialFrequency = frequency;
            grating.Orientation = orientation;
            GameObject plate = GameObject.CreatePrimitive(PrimitiveType.Quad); // 1 x 1 m, facing -z
            plate.name = title;
            plate.transform.SetParent(parent, false);
            plate.transform.localPosition = (place - 1) * Pitch * Vector3.right;
            plate.transform.localRotation = Quaternion.Euler(90f, 0f, 0f);
            plate.transform.localScale = Side * Vector3.one;
            var surface = plate.AddComponent<KnurlSurface>();
            surface.Axis = Vector3.right; // along the quad's u
            surface.Grating = grating;
            plate.AddComponent<KnurlPaint>();
            plate.AddComponent<KnurlStripes>();
        }
    }
}
