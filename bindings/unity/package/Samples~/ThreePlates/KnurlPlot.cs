// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl.Samples
{
    /// <summary>The last ticks, as the haptic thread played them: the grating's height above, the force below. The
    /// newest is at the right.</summary>
    internal sealed class KnurlPlot
    {
        internal const int Width = 400; // pixels, and ticks
        internal const int Height = 160; // pixels
        const int Half = Height / 2;
        const int Label = 24; // above each curve
        const int Curve = Half - Label;
        static readonly Color32 Paper = new Color32(23, 26, 33, 230);
        static readonly Color32 Rule = new Color32(70, 76, 86, 255);
        static readonly Color32 HeightInk = new Color32(255, 191, 90, 255);
        static readonly Color32 ForceInk = new Color32(90, 255, 191, 255);

        readonly Texture2D texture = new Texture2D(Width, Height, TextureFormat.RGBA32, false);
        readonly Color32[] pixels = new Color32[Width * Height];
        readonly float[] rows = new float[2 * Width];
        float heightEnd = 0.0003f; // m: end of the scale; grows if needed
        float forceEnd = 0.5f; // N

        internal void Draw(KnurlDevice device)
        {
            int ticks = device.GetHistory(rows);
            for (int i = 0; i < pixels.Length; i++)
            {
                pixels[i] = i / Width == Half || i / Width == Half + Curve / 2 ? Rule : Paper;
            }
            for (int i = 0; i < ticks; i++)
            {
                heightEnd = Mathf.Max(heightEnd, Mathf.Abs(rows[2 * i]));
                forceEnd = Mathf.Max(forceEnd, Mathf.Abs(rows[2 * i + 1]));
            }
            Trace(ticks, 0, Half, -heightEnd, heightEnd, HeightInk);
            Trace(ticks, 1, 0, 0f, forceEnd, ForceInk);
            texture.SetPixels32(pixels);
            texture.Apply();
        }

        /// <summary>Draws steps, not slopes, because a device holds each value until the next tick.</summary>
        void Trace(int ticks, int column, int bottom, float low, float high, Color32 ink)
        {
            int last = -1;
            for (int i = 0; i < ticks; i++)
            {
                float share = Mathf.Clamp01((rows[2 * i + column] - low) / (high - low));
                int y = bottom + Mathf.RoundToInt(share * (Curve - 1));
                int from = last < 0 ? y : Mathf.Min(y, last);
                int to = last < 0 ? y : Mathf.Max(y, last);
                for (int at = from; at <= to; at++)
                {
                    pixels[at * Width + Width - ticks + i] = ink;
                }
                last = y;
            }
        }

        internal void Show(Rect rect)
        {
            GUI.DrawTexture(rect, texture);
            GUI.Label(new Rect(rect.x + 6f, rect.y, 300f, Label), "height, to " + (1e3f * heightEnd).ToString("F2")
                + " mm");
            GUI.Label(new Rect(rect.x + 6f, rect.y + Half, 300f, Label), "force, to " + forceEnd.ToString("F2") + " N");
        }

        internal void Release()
        {
            Object.Destroy(texture);
        }
    }
}
