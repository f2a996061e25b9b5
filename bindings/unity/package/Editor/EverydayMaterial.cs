// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>A material of everyday things to start from.</summary>
    internal sealed partial class EverydayMaterial
    {
        readonly Vector2 spatialFrequency;
        readonly float amplitude, stiffness, friction, orientation;

        EverydayMaterial(string title, string period, string depth, Vector2 spatialFrequency, float amplitude,
            float stiffness, float friction, float orientation)
        {
            Title = title;
            Period = period;
            Depth = depth;
            this.spatialFrequency = spatialFrequency;
            this.amplitude = amplitude;
            this.stiffness = stiffness;
            this.friction = friction;
            this.orientation = orientation;
        }

        internal string Title { get; }

        /// <summary>From ridge to ridge, with the source of the number; "a guess" if nobody measured it.</summary>
        internal string Period { get; }

        /// <summary>From groove to ridge, likewise.</summary>
        internal string Depth { get; }

        /// <summary>A grating with its values, which is no asset yet.</summary>
        internal KnurlGrating Make()
        {
            var made = ScriptableObject.CreateInstance<KnurlGrating>();
            made.name = Title;
            made.SpatialFrequency = spatialFrequency;
            made.Amplitude = amplitude;
            made.Stiffness = stiffness;
            made.Friction = friction;
            made.Orientation = orientation;
            return made;
        }
    }
}
