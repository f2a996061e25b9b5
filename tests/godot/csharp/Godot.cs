// Stand-ins for the part of GodotSharp that addons/knurl/csharp/ and README.md use: names and signatures as in
// the engine's C# class reference. SPDX-License-Identifier: MIT
using System;

namespace Godot
{
    public struct Vector2 { }
    public struct Vector3 { public static Vector3 Up { get { return new Vector3(); } } }
    public struct Quaternion { }

    public sealed class StringName
    {
        public static implicit operator StringName(string from) { return new StringName(); }
    }

    public struct Variant
    {
        public bool AsBool() { return false; }
        public long AsInt64() { return 0; }
        public double AsDouble() { return 0.0; }
        public string AsString() { return ""; }
        public Vector2 AsVector2() { return new Vector2(); }
        public Vector3 AsVector3() { return new Vector3(); }
        public Quaternion AsQuaternion() { return new Quaternion(); }
        public float[] AsFloat32Array() { return null; }
        public double[] AsFloat64Array() { return null; }
        public string[] AsStringArray() { return null; }
        public Collections.Array AsGodotArray() { return null; }
        public Collections.Dictionary AsGodotDictionary() { return null; }
        public GodotObject AsGodotObject() { return null; }

        public static implicit operator Variant(bool from) { return new Variant(); }
        public static implicit operator Variant(long from) { return new Variant(); }
        public static implicit operator Variant(double from) { return new Variant(); }
        public static implicit operator Variant(string from) { return new Variant(); }
        public static implicit operator Variant(Vector2 from) { return new Variant(); }
        public static implicit operator Variant(Vector3 from) { return new Variant(); }
        public static implicit operator Variant(double[] from) { return new Variant(); }
        public static implicit operator Variant(GodotObject from) { return new Variant(); }
    }

    public struct Callable
    {
        public static Callable From<T0>(Action<T0> action) { return new Callable(); }
        public static Callable From<T0, T1>(Action<T0, T1> action) { return new Callable(); }
    }

    public enum Error : long { Ok }

    public class GodotObject
    {
        public bool IsClass(string name) { return false; }
        public Variant Get(StringName property) { return new Variant(); }
        public void Set(StringName property, Variant value) { }
        public Variant Call(StringName method, params Variant[] args) { return new Variant(); }
        public Error Connect(StringName signal, Callable callable, uint flags = 0u) { return Error.Ok; }
    }

    public class Resource : GodotObject { }

    public sealed class NodePath
    {
        public static implicit operator NodePath(string from) { return new NodePath(); }
    }

    public class Node : GodotObject
    {
        public StringName Name { get; set; }
        public Node GetParent() { return null; }
        public Node GetNode(NodePath path) { return null; }
    }

    public class Node3D : Node { }

    public static class GD
    {
        public static void Print(params object[] what) { }
    }

    public static class ClassDB
    {
        public static Variant Instantiate(StringName name) { return new Variant(); }
    }

    namespace Collections
    {
        public class Array { }
        public class Dictionary { }
    }
}
