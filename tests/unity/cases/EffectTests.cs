// SPDX-License-Identifier: MIT
using System.Text.RegularExpressions;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.TestTools;

namespace Knurl.Tests
{
    /// <summary>Forces at an object, without a surface, on a finger at the origin.</summary>
    [TestFixture]
    public class EffectTests : PlayerSuite
    {
        static KnurlEffect MakeEffect(EffectKind kind, Vector3 at)
        {
            KnurlEffect effect = new GameObject("Effect").AddComponent<KnurlEffect>();
            effect.Kind = kind;
            effect.Damping = 0f;
            effect.transform.position = at;
            return effect;
        }

        static void UntilForce(KnurlDevice d, Vector3 expected, string what)
        {
            Until(() => (d.Force - expected).magnitude < 0.01f, what);
        }

        [Test]
        public void ASpringPullsToItsObjectAndFollowsIt()
        {
            KnurlDevice d = StartMouse(Vector3.zero);
            KnurlEffect e = MakeEffect(EffectKind.Spring, new Vector3(0.005f, 0f, 0f));
            UntilForce(d, new Vector3(1f, 0f, 0f), "200 N/m over 5 mm, in Unity's axes");
            e.transform.position = new Vector3(0f, 0f, -0.004f);
            UntilForce(d, new Vector3(0f, 0f, -0.8f), "where the object went");
            e.Stiffness = 100f;
            UntilForce(d, new Vector3(0f, 0f, -0.4f), "as stiff as it is now");
            e.enabled = false;
            UntilForce(d, Vector3.zero, "disabled");
            e.enabled = true;
            UntilForce(d, new Vector3(0f, 0f, -0.4f), "enabled");
            e.Layers = 2;
            UntilForce(d, Vector3.zero, "on another layer");
            d.Layers = 3;
            UntilForce(d, new Vector3(0f, 0f, -0.4f), "which the device has, too");
            d.StopDevice();
            d.StartDevice();
            d.MoveHip(Vector3.zero);
            UntilForce(d, new Vector3(0f, 0f, -0.4f), "the next run has it");
            Object.DestroyImmediate(e.gameObject);
            UntilForce(d, Vector3.zero, "destroyed");
        }

        [Test]
        public void APlaneTurnsWithItsObject()
        {
            KnurlDevice d = StartMouse(Vector3.zero);
            KnurlEffect e = MakeEffect(EffectKind.Plane, new Vector3(0.002f, 0.002f, 0f));
            UntilForce(d, new Vector3(0f, 0.4f, 0f), "across y");
            e.transform.rotation = Quaternion.Euler(0f, 0f, 90f);
            UntilForce(d, new Vector3(0.4f, 0f, 0f), "across x");
            e.Kind = EffectKind.Force;
            e.Axis = new Vector3(0f, 0f, 3f);
            UntilForce(d, new Vector3(0f, 0f, 2f), "a force along z");
        }

        [Test]
        public void TooManyAndImpossibleOnesAreTold()
        {
            KnurlDevice d = StartMouse(Vector3.zero);
            KnurlEffect e = MakeEffect(EffectKind.Line, Vector3.zero);
            ExpectError("effects[0].axis: expected a vector with a length");
            e.Axis = Vector3.zero;
            Player.Frames(3);
            Object.DestroyImmediate(e.gameObject);
            LogAssert.Expect(LogType.Warning, new Regex("expected at most 8"));
            for (int i = 0; i < 9; i++)
            {
                MakeEffect(EffectKind.Force, Vector3.zero).MaxForce = 0.1f;
            }
            UntilForce(d, new Vector3(0f, 0.8f, 0f), "eight of nine");
        }
    }
}
