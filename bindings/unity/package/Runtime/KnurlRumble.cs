// SPDX-License-Identifier: MIT
using UnityEngine;
#if KNURL_INPUT_SYSTEM
using System;
using UnityEngine.InputSystem;
#endif

namespace Knurl
{
    /// <summary>Plays the force of the <see cref="KnurlDevice"/> on this object by a gamepad's two motors, for players without a
    /// device: they tell that there is a texture, not its ridges. Needs Unity's Input System; other packages can take the
    /// numbers from <see cref="KnurlDevice.GetRumble"/>. Main thread.</summary>
    [AddComponentMenu("Knurl/Knurl Rumble")]
    [HelpURL(Manual.Rumble)]
    [DefaultExecutionOrder(1001)] // after the device
    [DisallowMultipleComponent]
    [RequireComponent(typeof(KnurlDevice))]
    public sealed class KnurlRumble : MonoBehaviour
    {
        const float Least = 0.005f; // of the motors' strength: below it they do not turn

        [SerializeField, Tooltip("Which gamepad, in the order of the Input System's list, from 0. -1: the one that was used last.")]
        int gamepad = -1;

        [SerializeField, Range(0f, 1f), Tooltip("A factor on both motors, for a player's setting.")]
        float strength = 1f;

#if KNURL_INPUT_SYSTEM
        [NonSerialized] KnurlDevice device;
        [NonSerialized] Gamepad playing; // whose motors turn, or null
#endif

        /// <summary>Number of the gamepad in the Input System's list, from 0. -1, the default: the one that was used
        /// last.</summary>
        public int Gamepad
        {
            get { return gamepad; }
            set { gamepad = value; }
        }

        /// <summary>Factor on both motors, clamped to 0 to 1. Default 1.</summary>
        public float Strength
        {
            get { return strength; }
            set { strength = value; }
        }

#if KNURL_INPUT_SYSTEM
        void LateUpdate()
        {
            device = device == null ? GetComponent<KnurlDevice>() : device;
            Vector2 motors = Mathf.Clamp01(strength) * device.GetRumble();
            Gamepad wanted = gamepad < 0 ? UnityEngine.InputSystem.Gamepad.current
                : gamepad < UnityEngine.InputSystem.Gamepad.all.Count ? UnityEngine.InputSystem.Gamepad.all[gamepad] : null;
            bool isOn = motors.x > Least || motors.y > Least;
            if (playing != null && (!isOn || playing != wanted))
            {
                Stop();
            }
            if (isOn && wanted != null)
            {
                playing = wanted;
                playing.SetMotorSpeeds(motors.x, motors.y);
            }
        }

        void Stop()
        {
            if (playing != null)
            {
                playing.ResetHaptics();
                playing = null;
            }
        }

        void OnApplicationPause(bool pause)
        {
            Stop(); // motors turn until they are told otherwise
        }

        void OnDisable()
        {
            Stop();
        }
#else
        void OnEnable()
        {
            Debug.LogWarning("KnurlRumble '" + name + "': expected the package com.unity.inputsystem, which is not in this project: "
                + "no motor will turn", this);
        }
#endif
    }
}
