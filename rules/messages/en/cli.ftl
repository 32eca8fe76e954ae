# Why settings cannot be used.

config-unreadable = “{ $path }” cannot be read: { $reason }
    .help = check the path and the permissions
config-syntax = settings: { $what }
    .help = there are: language, store, rules, vehicle, user, color, units (docs/cli.md)
