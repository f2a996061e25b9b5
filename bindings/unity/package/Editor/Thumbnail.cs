// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>A picture of a grating: 10 x 10 mm of it, light where ridges are high.</summary>
    internal static class Thumbnail
    {
        const float Side = 0.01f; // m
        static readonly Color32 High = new Color32(225, 225, 225, 255);
        static readonly Color32 Low = new Color32(95, 95, 95, 255);

        internal static Color32[] Draw(KnurlGrating grating, int width, int height)
        {
            var pixels = new Color32[width * height];
            float cos = Mathf.Cos(grating.Orientation), sin = Mathf.Sin(grating.Orientation);
            for (int i = 0; i < pixels.Length; i++)
            {
                float u = Side * ((i % width + 0.5f) / width - 0.5f), v = Side * ((i / width + 0.5f) / height - 0.5f);
                float x = cos * u + sin * v, y = cos * v - sin * u; // counter-clockwise, as felt
                float waves = Mathf.Cos(2f * Mathf.PI * grating.SpatialFrequency.x * x)
                    * Mathf.Cos(2f * Mathf.PI * grating.SpatialFrequency.y * y);
                pixels[i] = grating.Amplitude == 0f || waves >= 0f ? High : Low;
            }
            return pixels;
        }
    }
}
