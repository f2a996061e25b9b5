// SPDX-License-Identifier: MIT
using System;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Knurl.Tests
{
    /// <summary>The editor's stand-ins against Unity's manual.</summary>
    [TestFixture]
    public class StandInEditorTests : PlayerSuite
    {
        enum Gaps
        {
            Five = 5,
            Ten = 10
        }

#pragma warning disable 649
        sealed class Numbers : ScriptableObject
        {
            public float size;
            public Gaps gap = Gaps.Five;
            [NonSerialized] public int passing;
            public readonly int constant;
            internal int Validated;
            void OnValidate() { Validated++; }
        }
#pragma warning restore 649

        Numbers Make()
        {
            return Made(ScriptableObject.CreateInstance<Numbers>());
        }

        [TearDown]
        public void ForgetAssets()
        {
            AssetDatabase.Clear();
        }

        [Test]
        public void APropertyIsWrittenWhenItIsApplied()
        {
            Numbers numbers = Make();
            var serialized = new SerializedObject(numbers);
            SerializedProperty size = serialized.FindProperty("size");
            size.floatValue = 2f;
            Assert.AreEqual(2f, size.floatValue);
            Assert.AreEqual(0f, numbers.size);
            Assert.IsTrue(serialized.ApplyModifiedProperties());
            Assert.AreEqual(2f, numbers.size);
            Assert.AreEqual(1, numbers.Validated);
            Assert.IsFalse(serialized.ApplyModifiedProperties(), "nothing is left to apply");
            Assert.AreEqual(1, numbers.Validated);
        }

        [Test]
        public void AnUpdateReadsAnewAndDropsWhatWasNotApplied()
        {
            Numbers numbers = Make();
            var serialized = new SerializedObject(numbers);
            SerializedProperty size = serialized.FindProperty("size");
            numbers.size = 3f;
            Assert.AreEqual(0f, size.floatValue, "as it was when the object was made");
            size.floatValue = 4f;
            serialized.Update();
            Assert.AreEqual(3f, size.floatValue);
            Assert.IsFalse(serialized.ApplyModifiedProperties());
            Assert.AreEqual(3f, numbers.size);
        }

        [Test]
        public void DifferentValuesOfTargetsAreKept()
        {
            Numbers one = Make(), two = Make();
            two.size = 1f;
            var serialized = new SerializedObject(new Object[] { one, two });
            serialized.FindProperty("gap").intValue = (int)Gaps.Ten;
            Assert.IsTrue(serialized.ApplyModifiedProperties());
            Assert.AreEqual(0f, one.size);
            Assert.AreEqual(1f, two.size);
            Assert.AreEqual(Gaps.Ten, two.gap);
        }

        [Test]
        public void AnEnumsNumberIsItsValue()
        {
            Assert.AreEqual(5, new SerializedObject(Make()).FindProperty("gap").intValue);
        }

        [Test]
        public void WhatIsNotSerializedIsNotFound()
        {
            var serialized = new SerializedObject(Make());
            Assert.IsNull(serialized.FindProperty("passing"));
            Assert.IsNull(serialized.FindProperty("constant"));
            Assert.Throws<ArgumentException>(() => new SerializedObject((Object)null));
            Assert.Throws<ArgumentNullException>(() => serialized.CopyFromSerializedProperty(null));
        }

        [Test]
        public void AFolderThatIsThereGetsANumberAndOneWithoutAParentIsNotMade()
        {
            AssetDatabase.CreateFolder("Assets", "A");
            Assert.AreEqual("Assets/A 1", AssetDatabase.GUIDToAssetPath(AssetDatabase.CreateFolder("Assets", "A")));
            Assert.AreEqual("", AssetDatabase.CreateFolder("Assets/B", "C"));
            Assert.IsFalse(AssetDatabase.IsValidFolder("Assets/B/C"));
        }

        [Test]
        public void AnAssetMovesToAFreePlaceOnly()
        {
            AssetDatabase.CreateFolder("Assets", "A");
            AssetDatabase.CreateFolder("Assets/A", "Below");
            AssetDatabase.CreateFolder("Assets", "B");
            Assert.AreNotEqual("", AssetDatabase.MoveAsset("Assets/A", "Assets/B"));
            Assert.AreNotEqual("", AssetDatabase.MoveAsset("Assets/A", "Assets/C/A"));
            Assert.AreNotEqual("", AssetDatabase.MoveAsset("Assets/D", "Assets/E"));
            Assert.IsTrue(AssetDatabase.IsValidFolder("Assets/A"));
            Assert.AreEqual("", AssetDatabase.MoveAsset("Assets/A", "Assets/E"));
            Assert.IsTrue(AssetDatabase.IsValidFolder("Assets/E/Below"));
        }

        [Test]
        public void ADeletedAssetIsDestroyed()
        {
            Numbers numbers = Make();
            AssetDatabase.CreateAsset(numbers, "Assets/Numbers.asset");
            AssetDatabase.DeleteAsset("Assets/Numbers.asset");
            Assert.That(numbers == null);
        }

        [Test]
        public void NothingCannotBeRegisteredForUndo()
        {
            Assert.Throws<ArgumentNullException>(() => Undo.RegisterCreatedObjectUndo(null, "Make"));
            Assert.Throws<ArgumentNullException>(() => Undo.AddComponent<MeshFilter>(null));
        }

        [Test]
        public void HandlesBeginWhiteAndInTheWorld()
        {
            Assert.AreEqual(Color.white, UnityEditor.Handles.color);
            Assert.AreEqual(Matrix4x4.identity, UnityEditor.Handles.matrix);
        }
    }
}
