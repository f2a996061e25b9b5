// Test-only, never shipped: materials, meshes and shaders for drawing.
using System;
using System.Collections.Generic;
using System.Reflection;

namespace UnityEngine
{
    public class Material : Object
    {
        public Material(Shader shader) { this.shader = shader; }
        public Shader shader { get; set; }
        public Color color { get; set; }

        /// For tests: the arguments of SetColor.
        public readonly Dictionary<string, Color> Colors = new Dictionary<string, Color>();
        public void SetColor(string name, Color value) { Colors[name] = value; }
    }

    /// Faithful: no shadows, as after Unity's constructor.
    public struct RenderParams
    {
        public RenderParams(Material mat) : this() { material = mat; }
        public Material material { get; set; }
        public int layer { get; set; }
        public Camera camera { get; set; }
    }

    /// Records each drawn mesh.
    public static class Graphics
    {
        public sealed class Drawing
        {
            public Mesh Mesh;
            public Matrix4x4 Matrix;
            public Material Material;
            public Camera Camera;
            public int Layer;
        }

        public static readonly List<Drawing> Drawn = new List<Drawing>();

        /// In Unity, the first is an `in` parameter and there is an optional fifth.
        public static void RenderMesh(RenderParams rparams, Mesh mesh, int submeshIndex, Matrix4x4 objectToWorld)
        {
            Drawn.Add(new Drawing
            {
                Mesh = mesh, Matrix = objectToWorld, Material = rparams.material, Camera = rparams.camera, Layer = rparams.layer
            });
        }
    }

    /// Shaders only, by their names.
    public static class Resources
    {
        public static T Load<T>(string path) where T : Object { return (T)(Object)new Shader { name = path }; }
    }

    /// Of every name there is one, without properties.
    public class Shader : Object
    {
        public Rendering.ShaderPropertyType[] Properties = new Rendering.ShaderPropertyType[0]; // a test's
        public static Shader Find(string name) { return new Shader { held = name }; }
        public int GetPropertyCount() { return Properties.Length; }
        public Rendering.ShaderPropertyType GetPropertyType(int propertyIndex) { return Properties[propertyIndex]; }
    }

    namespace Rendering
    {
        /// A pipeline names its shader; the built-in one is null.
        public class RenderPipelineAsset : ScriptableObject
        {
            public virtual Shader defaultShader { get { return null; } }
        }

        public struct ScriptableRenderContext { }

        public static class RenderPipelineManager
        {
            public static event Action<ScriptableRenderContext, Camera> beginCameraRendering;

            /// For tests: as URP and HDRP call it for a camera.
            public static void Begin(Camera camera)
            {
                if (beginCameraRendering != null)
                {
                    beginCameraRendering(new ScriptableRenderContext(), camera);
                }
            }
        }

        public static class GraphicsSettings
        {
            public static RenderPipelineAsset currentRenderPipeline { get; set; } // a test's; read-only in Unity
        }
    }

    public class Texture : Object
    {
        public int width { get; protected set; }
        public int height { get; protected set; }
    }

    public enum TextureFormat
    {
        RGBA32 = 4
    }

    /// Keeps its pixels for tests.
    public class Texture2D : Texture
    {
        public Color32[] Pixels;
        public Texture2D() { }
        public Texture2D(int width, int height, TextureFormat format, bool mipChain)
        {
            this.width = width;
            this.height = height;
        }

        public void SetPixels32(Color32[] colors)
        {
            if (colors.Length != width * height)
            {
                throw new UnityException("SetPixels32 called with invalid number of pixels in the array");
            }
            Pixels = colors;
        }

        public void Apply() { }
    }

    /// Faithful: sharedMaterials is a copy. Not: bounds, which a test sets; `material` is the shared one, in Unity a
    /// copy if another renderer has it, too.
    public class Renderer : Component
    {
        Material[] materials = { new Material(new Shader()) };
        bool shown = true;
        Bounds box;

        public bool enabled
        {
            get { Living(); return shown; }
            set { Living(); shown = value; }
        }

        public Material[] sharedMaterials
        {
            get { Living(); return (Material[])materials.Clone(); }
            set { Living(); materials = (Material[])value.Clone(); }
        }

        public Material sharedMaterial
        {
            get { Living(); return materials.Length > 0 ? materials[0] : null; }
            set
            {
                Living();
                if (materials.Length == 0)
                {
                    materials = new Material[1];
                }
                materials[0] = value;
            }
        }

        public Material material { get { return sharedMaterial; } set { sharedMaterial = value; } }

        public Bounds bounds
        {
            get { Living(); return box; }
            set { Living(); box = value; }
        }

        public bool isPartOfStaticBatch { get; set; } // read-only in Unity
    }

    public class MeshRenderer : Renderer { }
}
