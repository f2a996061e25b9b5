// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Events;
using UnityEngine.TestTools;
using Object = UnityEngine.Object;

namespace Knurl.Tests
{
    /// <summary>The stand-ins themselves, against what Unity's manual says of Unity.</summary>
    [TestFixture]
    public class StandInTests : PlayerSuite
    {
        static readonly List<string> Told = new List<string>();

        class Recorder : MonoBehaviour
        {
            void Awake() { Told.Add(name + " Awake"); }
            void OnEnable() { Told.Add(name + " OnEnable"); }
            void Start() { Told.Add(name + " Start"); }
            void Update() { Told.Add(name + " Update"); }
            void LateUpdate() { Told.Add(name + " LateUpdate"); }
            void OnDisable() { Told.Add(name + " OnDisable"); }
            void OnDestroy() { Told.Add(name + " OnDestroy"); }
            void OnApplicationQuit() { Told.Add(name + " OnApplicationQuit"); }
        }

        [DefaultExecutionOrder(10)]
        sealed class Late : Recorder { }

        sealed class Faulty : MonoBehaviour
        {
            void Update() { throw new InvalidOperationException("of Update"); }
            void LateUpdate() { Told.Add("LateUpdate"); }
        }

        [SetUp]
        public void Forget()
        {
            Told.Clear();
        }

        sealed class Listener : MonoBehaviour
        {
            internal void Hear(int value) { Told.Add(name + " " + value); }
        }

        [Test]
        public void AListenerOfADestroyedObjectIsNotCalled()
        {
            var told = new UnityEvent<int>();
            Listener gone = MakeObject("gone").AddComponent<Listener>(), there = MakeObject("there").AddComponent<Listener>();
            told.AddListener(gone.Hear);
            told.AddListener(there.Hear);
            Object.DestroyImmediate(gone);
            told.Invoke(7);
            Assert.AreEqual("there 7", Words(Told));
        }

        [Test]
        public void VectorsThatAreNoNumbersEqualNone()
        {
            var nothing = new Vector3(float.NaN, 0f, 0f);
            Assert.IsFalse(nothing.Equals(nothing));
            Vector3 same = nothing;
            Assert.IsFalse(nothing == same);
            Assert.Throws<IndexOutOfRangeException>(() => nothing[3] = 1f);
            Assert.AreEqual(Vector3.right, Vector3.ProjectOnPlane(Vector3.right, Vector3.zero));
        }

        [Test]
        public void AnglesArePositiveAndRaysOfLength1()
        {
            Assert.AreEqual(330f, Quaternion.Euler(-30f, 0f, 0f).eulerAngles.x, 1e-3f);
            Assert.AreEqual(Vector3.up, new Ray(Vector3.zero, 5f * Vector3.up).direction);
            float enter;
            Assert.IsTrue(new Plane(Vector3.up, Vector3.zero).Raycast(new Ray(Vector3.up, new Vector3(1f, -1e-5f, 0f)),
                out enter));
        }

        [Test]
        public void BoundsFollowIndicesAndNotVertices()
        {
            Mesh mesh = Made(new Mesh { vertices = new[] { Vector3.zero, Vector3.right, Vector3.up } });
            Assert.AreEqual(Vector3.zero, mesh.bounds.size);
            mesh.triangles = new[] { 0, 1, 2 };
            Assert.AreEqual(new Vector3(1f, 1f, 0f), mesh.bounds.size);
        }

        [Test]
        public void MessagesComeInUnitysOrder()
        {
            Recorder r = MakeObject("r").AddComponent<Recorder>();
            Assert.AreEqual("r Awake, r OnEnable", Words(Told), "at once");
            Player.Frame();
            Assert.AreEqual("r Awake, r OnEnable, r Start, r Update, r LateUpdate", Words(Told));
            Told.Clear();
            Object.Destroy(r);
            Assert.That(r != null, "until the frame's end");
            Player.Frame();
            Assert.That(r == null && !ReferenceEquals(r, null));
            Assert.AreEqual("r Update, r LateUpdate, r OnDisable, r OnDestroy", Words(Told));
            Assert.Throws<MissingReferenceException>(() => r.enabled = true);
        }

        [Test]
        public void AnInactiveObjectIsNotWoken()
        {
            GameObject go = MakeObject("r");
            go.SetActive(false);
            go.AddComponent<Recorder>();
            Player.Frame();
            Assert.AreEqual("", Words(Told));
            go.SetActive(true);
            Assert.AreEqual("r Awake, r OnEnable", Words(Told));
            go.SetActive(false);
            Assert.AreEqual("r Awake, r OnEnable, r OnDisable", Words(Told));
        }

        [Test]
        public void ExecutionOrderIsKept()
        {
            MakeObject("late").AddComponent<Late>();
            MakeObject("r").AddComponent<Recorder>();
            Player.Frame();
            Told.Clear();
            Player.Frame();
            Assert.AreEqual("r Update, late Update, r LateUpdate, late LateUpdate", Words(Told));
        }

        [Test]
        public void QuittingComesBeforeDisabling()
        {
            MakeObject("r").AddComponent<Recorder>();
            Action quitting = () => Told.Add("quitting");
            Application.quitting += quitting;
            Player.Quit();
            Application.quitting -= quitting;
            Assert.AreEqual("r Awake, r OnEnable, r OnApplicationQuit, quitting, r OnDisable, r OnDestroy", Words(Told));
        }

        [Test]
        public void AnExceptionIsLoggedAndEndsItsMessageOnly()
        {
            MakeObject("f").AddComponent<Faulty>();
            ExpectException("of Update");
            Player.Frame();
            Assert.AreEqual("LateUpdate", Words(Told));
        }

        [Test]
        public void NoMessagesInEditMode()
        {
            Player.ExitPlayMode();
            MakeObject("r").AddComponent<Recorder>();
            Player.Frame();
            Assert.AreEqual("", Words(Told));
            Player.EnterPlayMode();
            Assert.AreEqual("r Awake, r OnEnable", Words(Told));
        }

        [Test]
        public void AListenersExceptionLeavesInvoke()
        {
            var what = new UnityEvent();
            what.AddListener(() => { throw new InvalidOperationException(); });
            what.AddListener(() => Told.Add("behind it"));
            Assert.Throws<InvalidOperationException>(() => what.Invoke());
            Assert.AreEqual("", Words(Told));
        }

        [Test]
        public void ABodysErrorsAreExpectedInItAndInOrder()
        {
            Debug.Log("a plain line is fine");
            Debug.LogError("one");
            Debug.LogException(new InvalidOperationException("two"));
            LogAssert.Expect(LogType.Error, "one"); // before or after it comes
            ExpectException("two");
        }

        [Test]
        public void APlainLineIsReceivedToo()
        {
            LogAssert.NoUnexpectedReceived();
            Debug.Log("plain");
            Assert.Throws<Exception>(LogAssert.NoUnexpectedReceived);
            LogAssert.Expect(LogType.Log, "plain");
            LogAssert.NoUnexpectedReceived();
        }

        [Test]
        public void AScopeFailsOnWhatIsWrongInItAlone()
        {
            Debug.LogError("nobody expects this");
            Assert.Throws<Exception>(LogAssert.EndScope);
            LogAssert.Expect(LogType.Error, "this does not come");
            Assert.Throws<Exception>(LogAssert.EndScope);
            LogAssert.Expect(LogType.Error, "second");
            LogAssert.Expect(LogType.Error, "first");
            Debug.LogError("first");
            Debug.LogError("second");
            Assert.Throws<Exception>(LogAssert.EndScope);
            LogAssert.ignoreFailingMessages = true;
            Debug.LogError("ignored");
            LogAssert.EndScope();
            Debug.LogError("of the next scope, where it is not");
            Assert.Throws<Exception>(LogAssert.EndScope);
        }

        [Test]
        public void RotationsAreLeftHanded()
        {
            AreNear(Vector3.right, Quaternion.Euler(0f, 90f, 0f) * Vector3.forward, 1e-6);
            AreNear(Vector3.down, Quaternion.Euler(90f, 0f, 0f) * Vector3.forward, 1e-6);
            AreNear(Vector3.up, Quaternion.Euler(0f, 0f, 90f) * Vector3.right, 1e-6);
            // About z first, then x, then y.
            AreNear(Quaternion.AngleAxis(40f, Vector3.up) * (Quaternion.AngleAxis(30f, Vector3.right) *
                (Quaternion.AngleAxis(20f, Vector3.forward) * Vector3.one)), Quaternion.Euler(30f, 40f, 20f) * Vector3.one,
                1e-6);
        }

        [Test]
        public void MatricesAreColumnsOfAxes()
        {
            Transform t = MakeObject("t").transform;
            t.position = new Vector3(1f, 2f, 3f);
            t.rotation = Quaternion.Euler(10f, 20f, 30f);
            t.localScale = new Vector3(2f, 3f, 4f);
            Matrix4x4 m = t.localToWorldMatrix;
            AreNear(t.right * 2f, new Vector3(m.m00, m.m10, m.m20), 1e-5);
            AreNear(t.forward * 4f, new Vector3(m.m02, m.m12, m.m22), 1e-5);
            AreNear(t.position, new Vector3(m.m03, m.m13, m.m23), 1e-6);
            Assert.AreEqual(m.m12, m[1, 2]);
            Assert.AreEqual(m.m12, m[9]);
            AreNear(new Vector3(4f, 5f, 6f), t.InverseTransformPoint(t.TransformPoint(new Vector3(4f, 5f, 6f))), 1e-4);
        }
    }
}
