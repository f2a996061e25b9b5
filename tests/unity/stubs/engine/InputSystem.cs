// Test-only, never shipped: of com.unity.inputsystem 1.7's Gamepad, the motors. A test plugs gamepads in.
using System.Collections.Generic;

namespace UnityEngine.InputSystem
{
    public class Gamepad
    {
        public static readonly List<Gamepad> all = new List<Gamepad>();
        public static Gamepad current { get { return all.Count > 0 ? all[all.Count - 1] : null; } }

        /// For tests: the motors' strengths.
        public Vector2 Motors { get; private set; }
        public void SetMotorSpeeds(float lowFrequency, float highFrequency) { Motors = new Vector2(lowFrequency, highFrequency); }
        public void ResetHaptics() { Motors = Vector2.zero; }
    }
}
