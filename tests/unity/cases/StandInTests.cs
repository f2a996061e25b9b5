// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Reflection;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Events;
using UnityEngine.TestTools;
using Object = UnityEngine.Object;

namespace Knurl.Tests
{
    /// <summary>The stand-ins themselves against Unity's manual.</summary>
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
            var what = new UnityEvent<int>();
            what.AddListener(x => { throw new InvalidOperationException(); });
            what.AddListener(x => Told.Add("behind it"));
            Assert.Throws<InvalidOperationException>(() => what.Invoke(1));
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

        [DisallowMultipleComponent]
        class Single : MonoBehaviour { }

        sealed class OneKind : Single { }

        sealed class OtherKind : Single { }

        [Test]
        public void AKindOfWhatThereIsOneOfIsRefused()
        {
            GameObject holder = MakeObject("holder");
            holder.AddComponent<OneKind>();
            ExpectError("Can't add component 'OtherKind'");
            Assert.IsNull(holder.AddComponent<OtherKind>());
        }

        /// <summary>Destroying children immediately while enumerating them skips every second one.</summary>
        [Test]
        public void ChildrenAreCountedWhileTheyAreEnumerated()
        {
            Transform parent = MakeObject("parent").transform;
            for (int i = 0; i < 4; i++)
            {
                MakeObject("child " + i).transform.SetParent(parent);
            }
            foreach (Transform child in parent)
            {
                Object.DestroyImmediate(child.gameObject);
            }
            Assert.AreEqual(2, parent.childCount);
            Assert.Throws<UnityException>(() => parent.GetChild(2));
        }

        sealed class Stepping : MonoBehaviour
        {
            void FixedUpdate() { Told.Add("step of " + Time.deltaTime); }
        }

        [Test]
        public void InAPhysicsStepDeltaTimeIsThatOfTheStep()
        {
            MakeObject("s").AddComponent<Stepping>();
            Until(() => Told.Count > 0, "no step came");
            Assert.AreEqual("step of " + Time.fixedDeltaTime, Told[0]);
            Assert.AreEqual("", Words(Told.FindAll(line => line != Told[0])));
        }

        [Test]
        public void ADestroyedObjectAnswersNothing()
        {
            MeshRenderer drawn = MakeObject("r").AddComponent<MeshRenderer>();
            Listener gone = MakeObject("l").AddComponent<Listener>();
            var mesh = new Mesh();
            Object.DestroyImmediate(drawn);
            Object.DestroyImmediate(gone);
            Object.DestroyImmediate(mesh);
            object got = null;
            Assert.Throws<MissingReferenceException>(() => got = gone.isActiveAndEnabled);
            Assert.Throws<MissingReferenceException>(() => got = drawn.sharedMaterials);
            Assert.Throws<MissingReferenceException>(() => got = drawn.enabled);
            Assert.Throws<MissingReferenceException>(() => got = drawn.bounds);
            Assert.Throws<MissingReferenceException>(() => got = mesh.bounds);
            Assert.Throws<MissingReferenceException>(() => mesh.vertices = new Vector3[3]);
            Assert.IsNull(got);
        }

        [Test]
        public void ControlsAreEnabledFromTheBeginning()
        {
            Assert.IsTrue(GUI.enabled);
            Assert.AreEqual(Color.white, GUI.color);
        }
    }
}
