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
            MakeOne(parent, 0, "Paper, ridges of 1 mm", Make(new Vector2(1000f, 0f), 0.00027f, 700f));
            MakeOne(parent, 1, "Grid of 2 mm", Make(new Vector2(500f, 500f), 0.0002f, 400f));
            KnurlGrating knurl = Make(new Vector2(1000f, 1000f), 0.00015f, 600f);
            knurl.Friction = 0.3f;
            knurl.Orientation = 0.25f * Mathf.PI;
            MakeOne(parent, 2, "Knurled handle, 1 mm", knurl);
        }

        /// <summary>A preset's values. frequency: 1/m; amplitude: m; stiffness: N/m.</summary>
        static KnurlGrating Make(Vector2 frequency, float amplitude, float stiffness)
        {
            var grating = ScriptableObject.CreateInstance<KnurlGrating>();
            grating.SpatialFrequency = frequency;
            grating.Amplitude = amplitude;
            grating.Stiffness = stiffness;
            return grating;
        }

        static void MakeOne(Transform parent, int place, string title, KnurlGrating grating)
        {
            grating.name = title;
            GameObject plate = GameObject.CreatePrimitive(PrimitiveType.Quad); // 1 x 1 m, facing -z
            plate.name = title;
            plate.transform.SetParent(parent, false);
            plate.transform.localPosition = (place - 1) * Pitch * Vector3.right;
            plate.transform.localRotation = Quaternion.Euler(90f, 0f, 0f);
            plate.transform.localScale = Side * Vector3.one;
            plate.AddComponent<KnurlSurface>().Grating = grating; // x along the quad's u
            plate.AddComponent<KnurlPaint>();
            plate.AddComponent<KnurlStripes>();
        }
    }
}
