// Test-only, never shipped: see Player.cs.

namespace UnityEngine
{
    public static partial class Player
    {
        internal static void Add(GameObject go) { objects.Add(go); }
        internal static GameObject[] All() { return objects.ToArray(); }

        internal static void Keep(Object target)
        {
            Component part = target as Component;
            kept.Add(part != null ? part.gameObject : target);
        }

        internal static void Added(Component made)
        {
            MonoBehaviour b = made as MonoBehaviour;
            if (b == null)
            {
                return;
            }
            if (!Application.isPlaying)
            {
                Send(b, "Reset");
                Send(b, "OnValidate");
            }
            Wake(b);
        }

        static void Wake(MonoBehaviour b)
        {
            if (b.destroyed || !Runs(b) || !b.gameObject.activeInHierarchy)
            {
                return;
            }
            if (!b.woken)
            {
                b.woken = true;
                if (!Send(b, "Awake"))
                {
                    b.on = false;
                }
            }
            if (!b.destroyed && b.on && !b.running && b.gameObject.activeInHierarchy)
            {
                b.running = true;
                Send(b, "OnEnable");
            }
        }

        static void Disable(MonoBehaviour b)
        {
            if (b.running)
            {
                b.running = false;
                Send(b, "OnDisable");
            }
        }

        internal static void EnabledChanged(Behaviour behaviour)
        {
            MonoBehaviour b = behaviour as MonoBehaviour;
            if (b == null)
            {
                return;
            }
            if (b.on)
            {
                Wake(b);
            }
            else
            {
                Disable(b);
            }
        }

        internal static void ActivityChanged(GameObject go)
        {
            bool isActive = go.activeInHierarchy;
            foreach (Component part in go.parts.ToArray())
            {
                MonoBehaviour b = part as MonoBehaviour;
                if (b != null && isActive)
                {
                    Wake(b);
                }
                else if (b != null)
                {
                    Disable(b);
                }
            }
            foreach (Transform child in go.transform.children.ToArray())
            {
                if (child.gameObject.active)
                {
                    ActivityChanged(child.gameObject);
                }
            }
        }

        internal static void DestroyLater(Object target)
        {
            if (target == null)
            {
                return;
            }
            if (!Application.isPlaying)
            {
                Debug.LogError("Destroy may not be called from edit mode! Use DestroyImmediate instead.");
                return;
            }
            dying.Add(target);
        }

        static void BuryTheDead()
        {
            for (int i = 0; i < dying.Count; i++)
            {
                DestroyNow(dying[i]);
            }
            dying.Clear();
        }

        internal static void DestroyNow(Object target)
        {
            if (target == null)
            {
                return;
            }
            if (target.ending)
            {
                Debug.LogError("Destroying object multiple times. Don't use DestroyImmediate on the same object in "
                    + "OnDisable or OnDestroy.");
                return;
            }
            target.ending = true;
            GameObject go = target as GameObject;
            Component part = target as Component;
            if (go != null)
            {
                DisableAll(go);
                EndAll(go);
            }
            else if (part != null)
            {
                MonoBehaviour b = part as MonoBehaviour;
                if (b != null)
                {
                    Disable(b);
                    End(b);
                }
                part.owner.parts.Remove(part);
                part.destroyed = true;
            }
            else
            {
                if (target is ScriptableObject)
                {
                    Send(target, "OnDisable");
                    Send(target, "OnDestroy");
                }
                target.destroyed = true;
            }
        }

        static void DisableAll(GameObject go)
        {
            foreach (Component part in go.parts.ToArray())
            {
                if (part is MonoBehaviour)
                {
                    Disable((MonoBehaviour)part);
                }
            }
            foreach (Transform child in go.transform.children.ToArray())
            {
                DisableAll(child.gameObject);
            }
        }

        static void End(MonoBehaviour b)
        {
            if (b.woken)
            {
                Send(b, "OnDestroy");
            }
        }

        static void EndAll(GameObject go)
        {
            foreach (Transform child in go.transform.children.ToArray())
            {
                EndAll(child.gameObject);
            }
            foreach (Component part in go.parts)
            {
                if (part is MonoBehaviour)
                {
                    End((MonoBehaviour)part);
                }
            }
            go.transform.Detach();
            foreach (Component part in go.parts)
            {
                part.destroyed = true;
            }
            go.destroyed = true;
            objects.Remove(go);
        }
    }
}
