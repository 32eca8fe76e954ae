# Почему настройки непригодны.

config-unreadable = «{ $path }» не читается: { $reason }
    .help = проверьте путь и права доступа
config-syntax = настройки: { $what }
    .help = бывают: language, store, rules, vehicle, user, color, units (docs/cli.md)
