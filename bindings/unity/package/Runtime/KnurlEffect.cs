// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl
{
    /// <summary>A force without a surface on the finger of every running <see cref="KnurlDevice"/> that shares a layer with
    /// it, at most 8 on a device: a spring, notches, a liquid, a guide. It is anchored at the object's position, moves and
    /// turns with the object, and is felt in the frame after a change. All effects of a device together are held to the
    /// stiffness and damping that a loosely held device holds steady. Values are checked when a device uses them: one out
    /// of range is an error in the console, and the device's effects stay as they were. Main thread.</summary>
    [AddComponentMenu("Knurl/Knurl Effect")]
    [HelpURL(Manual.Effect)]
    public sealed class KnurlEffect : MonoBehaviour
    {
        [SerializeField, Tooltip("The kind of effect.")]
        EffectKind kind = EffectKind.Spring;

        [SerializeField, Tooltip("Its axis in the object's own axes, of any length: along a line, across a plane, along "
            + "notches, the direction of a force.")]
        Vector3 axis = Vector3.up;

        [SerializeField, Min(0f), Tooltip("0, or 1 and more; of a Detent at the bottom of a notch. N/m")]
        float stiffness = 200f;

        [SerializeField, Min(0f), Tooltip("0 to 1000. N s/m")]
        float damping = 1f;

        [SerializeField, Min(0f), Tooltip("From notch to notch of a Detent. m")]
        float spacing = 0.01f;

        [SerializeField, Min(0f), Tooltip("The longest force of this effect, 0.01 to 1000; of a Force the force itself. N")]
        float maxForce = 2f;

        [SerializeField, Layers, Tooltip("Only devices feel it that have one of these layers too.")]
        int layers = 1;

        /// <summary>The kind of effect. Default Spring.</summary>
        public EffectKind Kind
        {
            get { return kind; }
            set { kind = value; }
        }

        /// <summary>Its axis in the object's own axes, of any length: along a line, across a plane, along notches, the
        /// direction of a force. The object's scale is ignored. Default (0, 1, 0).</summary>
        public Vector3 Axis
        {
            get { return axis; }
            set { axis = value; }
        }

        /// <summary>Stiffness (N/m), 0 or 1 and more; of a Detent at the bottom of a notch. Default 200.</summary>
        public float Stiffness
        {
            get { return stiffness; }
            set { stiffness = value; }
        }

        /// <summary>Damping (N s/m), 0 to 1000. Default 1.</summary>
        public float Damping
        {
            get { return damping; }
            set { damping = value; }
        }

        /// <summary>Distance of two notches of a Detent (m). Default 0.01.</summary>
        public float Spacing
        {
            get { return spacing; }
            set { spacing = value; }
        }

        /// <summary>The longest force of this effect (N), 0.01 to 1000; of a Force the force itself. Default 2.</summary>
        public float MaxForce
        {
            get { return maxForce; }
            set { maxForce = value; }
        }

        /// <summary>Only devices feel it that have one of these layers too. Default 1.</summary>
        public int Layers
        {
            get { return layers; }
            set { layers = value; }
        }

        internal unsafe void Describe(knurl_effect* to)
        {
            *to = default(knurl_effect);
            to->kind = (int)kind;
            Axes.ToScene(transform.position, to->anchor);
            Axes.ToScene(transform.rotation * axis, to->axis);
            to->stiffness = stiffness;
            to->damping = damping;
            to->spacing = spacing;
            to->max_force = maxForce;
        }

        void OnEnable()
        {
            Registry.Effects.Add(this);
        }

        void OnDisable()
        {
            Registry.Effects.Remove(this);
        }
    }
}
