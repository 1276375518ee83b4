# Completion of dstylize for bash.
_dstylize() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} verb=${COMP_WORDS[1]}
    local styles='' words=''
    local output='--size --scale -o --output --format --quality --compression --recipe --no-recipe -f --force
        --dry-run -q --quiet -v --verbose --json --threads --max-memory --allow-damaged -h --help'
    local draw='-s --style --set --detail --seed --root --mask --importance --importance-mode --endpoints
        --background --place --blend --show --include --name --manifest --shard --watch --help-all --version'
    local draw_slurm='--nodes --shards --slurm --submit'
    local draw_words='--font --text-size --align --letter-spacing --line-spacing'
    COMPREPLY=()
    if [[ $before == -s || $before == --style || ($verb == styles && $COMP_CWORD == 2) ]]; then
        styles=$("${COMP_WORDS[0]}" styles 2>/dev/null | cut -d ' ' -f 1)
    fi
    case $before in
    -s | --style) words=$styles ;;
    --importance-mode) words='multiply replace' ;;
    --align) words='left centre right' ;;
    --font) words=$(fc-list : family 2>/dev/null | cut -d , -f 1) ;;
    --format) words='png jpg tif webp svg pdf json' ;;
    --root) words='bottom top centre darkest' ;;
    --blend) words='over multiply screen soft-light' ;;
    --background) words='input none' ;;
    --show) words=$("${COMP_WORDS[0]}" styles --fields 2>/dev/null | grep -v '^--' | cut -d ' ' -f 1)' weights endpoints distance owners tree' ;;
    --set | --detail | --seed | --size | --scale | --quality | --compression | --text-size | --place | --letter-spacing | --line-spacing | --include | --name | --shard | --nodes | --shards | --slurm | --threads | --max-memory) return ;;
    *)
        if [[ $verb == styles ]]; then
            words="$styles --fields --copy -f --force -h --help"
        elif [[ $verb == merge-reports ]]; then
            words='--json -q --quiet -h --help'
        elif [[ $word == -* ]]; then
            words=$output
            [[ $verb == replay ]] || words+=" $draw"
            [[ $verb != write ]] || words+=" $draw_words"
            [[ $verb != sbatch ]] || words+=" $draw_slurm"
        elif ((COMP_CWORD == 1)); then
            words='styles write replay sbatch merge-reports'
        fi
        ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
    [[ $word == -* ]] || mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$word")
}
complete -o filenames -F _dstylize dstylize
