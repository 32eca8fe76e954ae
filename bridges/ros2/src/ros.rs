//! A node of ROS 2 by DDS alone, and how its topics, services and actions are offered and asked.

use std::thread;

use ros2_client::action::{
    ActionClient, ActionClientQosPolicies, ActionServer, ActionServerQosPolicies,
};
use ros2_client::qos::{Durability, History, WhenFull};
use ros2_client::service::Server;
use ros2_client::{
    ActionTypeName, Context, ContextOptions, Message, MessageTypeName, Name, Node, NodeName,
    NodeOptions, Publisher, QosProfile, ServiceMapping, ServiceTypeName, Subscription,
};
use serde::Serialize;

/// Why the bridge cannot go on, in words.
pub(crate) type Fault = String;

/// How a topic's messages are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kept {
    /// The newest, as sensors say them: one that is lost is lost.
    Newest,
    /// All that is said from now on.
    Said,
    /// Also the last, for who comes later.
    Latched,
}

impl Kept {
    fn qos(self) -> QosProfile {
        let reliable = QosProfile::publisher_default().reliability_reliable(WhenFull::DEFAULT);
        match self {
            Self::Newest => {
                QosProfile::subscription_default().history(History::KeepLast { depth: 5 })
            }
            Self::Said => reliable.history(History::KeepLast { depth: 100 }),
            Self::Latched => reliable
                .durability(Durability::TransientLocal)
                .history(History::KeepLast { depth: 10 }),
        }
    }
}

/// The node, and how services are mapped to topics: each middleware of ROS has its own way.
pub(crate) struct Ros {
    node: Node,
    mapping: ServiceMapping,
}

impl Ros {
    /// # Errors
    /// There is no network.
    pub(crate) fn new(name: &str, domain: u16, mapping: ServiceMapping) -> Result<Self, Fault> {
        let options = ContextOptions::new().domain_id(domain);
        let context =
            Context::with_options(options).map_err(|e| format!("no DDS participant: {e:?}"))?;
        let name = NodeName::new("/", name).map_err(|e| format!("{name}: {e:?}"))?;
        let mut node =
            context.new_node(name, NodeOptions::new()).map_err(|e| format!("no node: {e:?}"))?;
        let spinner = node.spinner().map_err(|e| format!("no spinner: {e:?}"))?;
        // It ends with the program.
        thread::spawn(move || futures::executor::block_on(spinner.spin()));
        Ok(Self { node, mapping })
    }

    pub(crate) fn node(&self) -> &Node {
        &self.node
    }

    fn name(name: &str) -> Result<Name, Fault> {
        Name::parse(name).map_err(|e| format!("{name}: {e:?}"))
    }

    pub(crate) fn subscribe<M: Message + 'static>(
        &mut self,
        topic: &str,
        (package, kind): (&str, &str),
        kept: Kept,
    ) -> Result<Subscription<M>, Fault> {
        let told = |e: &dyn std::fmt::Debug| format!("{topic} cannot be heard: {e:?}");
        let (name, kind) = (Self::name(topic)?, MessageTypeName::new(package, kind));
        let found = self.node.create_topic(&name, kind, &kept.qos()).map_err(|e| told(&e))?;
        self.node.create_subscription(&found, Some(kept.qos())).map_err(|e| told(&e))
    }

    pub(crate) fn publish<M: Serialize>(
        &mut self,
        topic: &str,
        (package, kind): (&str, &str),
        kept: Kept,
    ) -> Result<Publisher<M>, Fault> {
        let told = |e: &dyn std::fmt::Debug| format!("{topic} cannot be published: {e:?}");
        let (name, kind) = (Self::name(topic)?, MessageTypeName::new(package, kind));
        let found = self.node.create_topic(&name, kind, &kept.qos()).map_err(|e| told(&e))?;
        self.node.create_publisher(&found, Some(kept.qos())).map_err(|e| told(&e))
    }

    pub(crate) fn action_client<G, R, F>(
        &mut self,
        action: &str,
        (package, kind): (&str, &str),
    ) -> Result<ActionClient<G, R, F>, Fault>
    where
        G: Message + Clone + 'static,
        R: Message + Clone + 'static,
        F: Message + 'static,
    {
        let qos = ActionClientQosPolicies {
            goal_service: Kept::Said.qos(),
            result_service: Kept::Said.qos(),
            cancel_service: Kept::Said.qos(),
            feedback_subscription: Kept::Said.qos(),
            status_subscription: Kept::Latched.qos(),
        };
        let kind = ActionTypeName::new(package, kind);
        let made = self.node.create_action_client(self.mapping, &Self::name(action)?, &kind, qos);
        made.map_err(|e| format!("{action} cannot be asked: {e:?}"))
    }

    pub(crate) fn action_server<G, R, F>(
        &mut self,
        action: &str,
        (package, kind): (&str, &str),
    ) -> Result<ActionServer<G, R, F>, Fault>
    where
        G: Message + Clone + 'static,
        R: Message + Clone + 'static,
        F: Message + 'static,
    {
        let qos = ActionServerQosPolicies {
            goal_service: Kept::Said.qos(),
            result_service: Kept::Said.qos(),
            cancel_service: Kept::Said.qos(),
            feedback_publisher: Kept::Said.qos(),
            status_publisher: Kept::Latched.qos(),
        };
        let kind = ActionTypeName::new(package, kind);
        let made = self.node.create_action_server(self.mapping, &Self::name(action)?, &kind, qos);
        made.map_err(|e| format!("{action} cannot be offered: {e:?}"))
    }

    pub(crate) fn server<Q: Message + Clone + 'static, A: Message + 'static>(
        &mut self,
        service: &str,
        (package, kind): (&str, &str),
    ) -> Result<Server<Q, A>, Fault> {
        let kind = ServiceTypeName::new(package, kind);
        let (ask, answer) = (Kept::Said.qos(), Kept::Said.qos());
        let made = self.node.create_server(self.mapping, &Self::name(service)?, &kind, ask, answer);
        made.map_err(|e| format!("{service} cannot be offered: {e:?}"))
    }
}
