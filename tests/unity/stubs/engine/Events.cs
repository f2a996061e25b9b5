// Test-only stand-ins, never shipped. Faithful: a listener's exception leaves Invoke and keeps those behind it from
// being called; who is added during a call is called from the next on; nothing is allocated by a call. Not: listeners
// that a scene stores.
using System;
using System.Collections.Generic;

namespace UnityEngine.Events
{
    public delegate void UnityAction();
    public delegate void UnityAction<T0>(T0 arg0);
    public delegate void UnityAction<T0, T1>(T0 arg0, T1 arg1);

    public abstract class UnityEventBase
    {
        readonly List<Delegate> listeners = new List<Delegate>();
        Delegate[] ready;

        protected void Add(Delegate call) { listeners.Add(call); ready = null; }

        protected void Remove(Delegate call)
        {
            listeners.RemoveAll(held => held.Equals(call));
            ready = null;
        }

        protected Delegate[] Prepare() { return ready ?? (ready = listeners.ToArray()); }
        public void RemoveAllListeners() { listeners.Clear(); ready = null; }
        public int GetPersistentEventCount() { return 0; }
    }

    [Serializable]
    public class UnityEvent : UnityEventBase
    {
        public void AddListener(UnityAction call) { Add(call); }
        public void RemoveListener(UnityAction call) { Remove(call); }
        public void Invoke()
        {
            foreach (Delegate call in Prepare())
            {
                ((UnityAction)call)();
            }
        }
    }

    [Serializable]
    public class UnityEvent<T0> : UnityEventBase
    {
        public void AddListener(UnityAction<T0> call) { Add(call); }
        public void RemoveListener(UnityAction<T0> call) { Remove(call); }
        public void Invoke(T0 arg0)
        {
            foreach (Delegate call in Prepare())
            {
                ((UnityAction<T0>)call)(arg0);
            }
        }
    }

    [Serializable]
    public class UnityEvent<T0, T1> : UnityEventBase
    {
        public void AddListener(UnityAction<T0, T1> call) { Add(call); }
        public void RemoveListener(UnityAction<T0, T1> call) { Remove(call); }
        public void Invoke(T0 arg0, T1 arg1)
        {
            foreach (Delegate call in Prepare())
            {
                ((UnityAction<T0, T1>)call)(arg0, arg1);
            }
        }
    }
}
