// SPDX-License-Identifier: MIT
using NUnit.Framework;
using UnityEngine;
using UnityEngine.InputSystem;

namespace Knurl.Tests
{
    /// <summary>The force, played by a gamepad's motors; the Input System is a stand-in.</summary>
    [TestFixture]
    public class RumbleTests : PlayerSuite
    {
        KnurlDevice device;
        Gamepad one, two;

        [SetUp]
        public void PlugIn()
        {
            Gamepad.all.Clear();
            Gamepad.all.Add(one = new Gamepad());
            Gamepad.all.Add(two = new Gamepad());
            MakeSurface(Plate());
            device = MakeDevice("fake", "sweep");
            device.gameObject.AddComponent<KnurlRumble>();
            Assert.That(device.StartDevice());
        }

        [TearDown]
        public void PullOut()
        {
            Gamepad.all.Clear();
        }

        [Test]
        public void RidgesTurnTheMotorsOfTheGamepadUsedLast()
        {
            Until(() => two.Motors.magnitude > 0.05f, "they turn");
            Assert.AreEqual(Vector2.zero, one.Motors);
            device.StopDevice();
            Player.Frame();
            Assert.AreEqual(Vector2.zero, two.Motors, "nothing runs");
            Assert.AreEqual(Vector2.zero, device.GetRumble());
        }

        [Test]
        public void AGameWithoutAudioRumbles()
        {
            int rate = AudioSettings.outputSampleRate;
            device.StopDevice();
            Assert.That(device.StartDevice());
            AudioSettings.outputSampleRate = 0;
            try
            {
                Until(() => two.Motors.magnitude > 0.05f, "they turn");
            }
            finally
            {
                AudioSettings.outputSampleRate = rate;
            }
        }

        [Test]
        public void AnotherGamepadCanBeChosenAndStopsTheFirst()
        {
            Until(() => two.Motors.magnitude > 0.05f, "they turn");
            device.GetComponent<KnurlRumble>().Gamepad = 0;
            Until(() => one.Motors.magnitude > 0.05f, "the other's turn");
            Assert.AreEqual(Vector2.zero, two.Motors);
            device.GetComponent<KnurlRumble>().Gamepad = 7;
            Player.Frame();
            Assert.AreEqual(Vector2.zero, one.Motors, "there are two");
        }

        [Test]
        public void NothingTurnsWithoutAForce()
        {
            Until(() => two.Motors.magnitude > 0.05f, "they turn");
            device.Paused = true;
            Until(() => two.Motors == Vector2.zero, "a pause");
            device.Paused = false;
            Until(() => two.Motors.magnitude > 0.05f, "they turn again");
            device.GetComponent<KnurlRumble>().Strength = 0f;
            Player.Frame();
            Assert.AreEqual(Vector2.zero, two.Motors);
        }

        [TestCase(true)]
        [TestCase(false)]
        public void MotorsStopWithTheComponentAndInTheBackground(bool isDisabled)
        {
            Until(() => two.Motors.magnitude > 0.05f, "they turn");
            if (isDisabled)
            {
                device.GetComponent<KnurlRumble>().enabled = false;
            }
            else
            {
                Player.Pause(true);
            }
            Assert.AreEqual(Vector2.zero, two.Motors);
        }
    }
}
